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

/// The steps applied to each item of a stream. Steps marked "in order" see one item at a time, in
/// the order of reading, and need no locks; the others may process several items concurrently.
template <class Item>
struct PipelineSteps {
    std::function<bool(Item&)> read;  ///< in order; false: no more items
    std::function<void(Item&)> work;
    std::function<void(Item&)> account;  ///< in order
    std::function<void(Item&)> pack;
    std::function<void(Item&)> write;  ///< in order
};

/// Storage of an item in a pipeline. TBB ensures that only one thread has it at a time, so its lock
/// is never contended. It is for ThreadSanitizer, which cannot see TBB's synchronisation (and
/// still reports the start and end of a pipeline).
template <class Item>
struct PipelinePlace {
    Item item;
    std::mutex lock;
    ~PipelinePlace() { const std::lock_guard last(lock); }
};

/// A pool of reusable places.
template <class Item>
class PipelinePlaces {
 public:
    using Place = PipelinePlace<Item>;

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

/// Runs all items through the steps on up to `threads` threads; with one thread, item by item on
/// the caller's. An exception in a step ends the pipeline and is rethrown; items before it may or
/// may not be written then. Holds two items per thread in memory.
template <class Item>
void runPipeline(const PipelineSteps<Item>& steps, std::size_t threads) {
    if (threads == 1) {
        for (Item item; steps.read(item);) {
            steps.work(item);
            steps.account(item);
            steps.pack(item);
            steps.write(item);
        }
        return;
    }
    const std::size_t most = 2 * threads;  // one in work, one waiting for its turn
    PipelinePlaces<Item> places(most);
    using Place = PipelinePlace<Item>;

    std::mutex reads, accounts, writes;  // never contended either
    const auto read = [&](tbb::flow_control& flow) -> Place* {
        Place* const place = places.take();
        const std::scoped_lock lock(place->lock, reads);
        if (steps.read(place->item)) return place;
        flow.stop();
        return nullptr;
    };
    const auto side_by_side = [](const auto& step) {
        return tbb::make_filter<Place*, Place*>(tbb::filter_mode::parallel, [&](Place* place) {
            const std::lock_guard lock(place->lock);
            step(place->item);
            return place;
        });
    };
    const auto account = [&](Place* place) {
        const std::scoped_lock lock(place->lock, accounts);
        steps.account(place->item);
        return place;
    };
    const auto write = [&](Place* place) {
        {
            const std::scoped_lock lock(place->lock, writes);
            steps.write(place->item);
        }
        places.giveBack(place);
    };
    constexpr auto in_order = tbb::filter_mode::serial_in_order;

    // TBB prints a warning if a pipeline has more threads than cores, unless this allows them.
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
