#pragma once
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace hagen::logs {

inline std::size_t coresOfThisMachine() {
    return static_cast<std::size_t>(tbb::info::default_concurrency());
}

/// What is done to each of a stream of pieces. Steps "in order" see one piece at a time, in the
/// order in which they were read, and need no locks of their own; the others may work on several.
template <class Piece>
struct PipelineSteps {
    std::function<bool(Piece&)> read;  ///< in order; no: there are no more
    std::function<void(Piece&)> work;
    std::function<void(Piece&)> account;  ///< in order
    std::function<void(Piece&)> pack;
    std::function<void(Piece&)> write;  ///< in order
};

/// A piece's place in a pipeline. TBB alone sees to it that one thread has it at a time, and nobody
/// ever waits for its lock; that is for ThreadSanitizer, which does not see into TBB (and still
/// frets about how a pipeline begins and ends).
template <class Piece>
struct PipelinePlace {
    Piece piece;
    std::mutex lock;
    ~PipelinePlace() { const std::lock_guard last(lock); }
};

/// Places that are used again and again.
template <class Piece>
class PipelinePlaces {
 public:
    using Place = PipelinePlace<Piece>;

    explicit PipelinePlaces(std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) {
            giveBack(places_.emplace_back(std::make_unique<Place>()).get());
        }
    }
    ~PipelinePlaces() { const std::lock_guard last(is_used_); }
    Place* take() {
        const std::lock_guard lock(is_used_);
        Place* const place = idle_.back();
        idle_.pop_back();
        return place;
    }
    void giveBack(Place* place) {
        const std::lock_guard lock(is_used_);
        idle_.push_back(place);
    }

 private:
    std::vector<std::unique_ptr<Place>> places_;
    std::vector<Place*> idle_;
    std::mutex is_used_;
};

/// Takes all pieces through the steps, on up to `threads` threads; on one, piece by piece, and by
/// the caller's own. A step that throws ends it, with what it threw: pieces before it may then be
/// written or not. Memory is that of two pieces a thread.
template <class Piece>
void runPipeline(const PipelineSteps<Piece>& steps, std::size_t threads) {
    if (threads == 1) {
        for (Piece piece; steps.read(piece);) {
            steps.work(piece);
            steps.account(piece);
            steps.pack(piece);
            steps.write(piece);
        }
        return;
    }
    const std::size_t most = 2 * threads;  // one to work on, one to wait for its turn
    PipelinePlaces<Piece> places(most);
    using Place = PipelinePlace<Piece>;

    std::mutex reads, accounts, writes;  // never waited for, either
    const auto read = [&](tbb::flow_control& flow) -> Place* {
        Place* const place = places.take();
        const std::scoped_lock lock(place->lock, reads);
        if (steps.read(place->piece)) return place;
        flow.stop();
        return nullptr;
    };
    const auto side_by_side = [](const auto& step) {
        return tbb::make_filter<Place*, Place*>(tbb::filter_mode::parallel, [&](Place* place) {
            const std::lock_guard lock(place->lock);
            step(place->piece);
            return place;
        });
    };
    const auto account = [&](Place* place) {
        const std::scoped_lock lock(place->lock, accounts);
        steps.account(place->piece);
        return place;
    };
    const auto write = [&](Place* place) {
        {
            const std::scoped_lock lock(place->lock, writes);
            steps.write(place->piece);
        }
        places.giveBack(place);
    };
    constexpr auto in_order = tbb::filter_mode::serial_in_order;

    // More threads than cores have to be allowed, or TBB grumbles.
    std::optional<tbb::global_control> more;
    if (threads > coresOfThisMachine()) {
        more.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    tbb::task_arena(static_cast<int>(threads)).execute([&] {
        tbb::parallel_pipeline(
            most, tbb::make_filter<void, Place*>(in_order, read) & side_by_side(steps.work) &
                      tbb::make_filter<Place*, Place*>(in_order, account) &
                      side_by_side(steps.pack) & tbb::make_filter<Place*, void>(in_order, write));
    });
}

}  // namespace hagen::logs
