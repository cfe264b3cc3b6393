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

namespace hagen {

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

/// Takes all pieces through the steps, on up to `threads` threads; on one, piece by piece, and by
/// the caller's own. A step that throws ends it, with what it threw: pieces before it may then be
/// written or not. Memory is that of two pieces a thread, which are used again and again.
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
    std::vector<std::unique_ptr<Piece>> pieces;
    std::vector<Piece*> idle;
    std::mutex idle_is_used;  // read and write may meet
    for (std::size_t i = 0; i < most; ++i) {
        idle.push_back(pieces.emplace_back(std::make_unique<Piece>()).get());
    }
    const auto take = [&] {
        const std::lock_guard lock(idle_is_used);
        Piece* const piece = idle.back();
        idle.pop_back();
        return piece;
    };
    const auto giveBack = [&](Piece* piece) {
        const std::lock_guard lock(idle_is_used);
        idle.push_back(piece);
    };
    const auto step = [](tbb::filter_mode mode, const std::function<void(Piece&)>& does) {
        return tbb::make_filter<Piece*, Piece*>(mode, [&does](Piece* piece) {
            does(*piece);
            return piece;
        });
    };
    const auto in_order = tbb::filter_mode::serial_in_order, in_any = tbb::filter_mode::parallel;
    // More threads than cores have to be allowed, or TBB grumbles.
    std::optional<tbb::global_control> more;
    if (threads > coresOfThisMachine()) {
        more.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] {
        tbb::parallel_pipeline(
            most, tbb::make_filter<void, Piece*>(in_order,
                                                 [&](tbb::flow_control& flow) -> Piece* {
                                                     Piece* const piece = take();
                                                     if (steps.read(*piece)) return piece;
                                                     flow.stop();
                                                     return nullptr;
                                                 }) &
                      step(in_any, steps.work) & step(in_order, steps.account) &
                      step(in_any, steps.pack) &
                      tbb::make_filter<Piece*, void>(in_order, [&](Piece* piece) {
                          steps.write(*piece);
                          giveBack(piece);
                      }));
    });
}

}  // namespace hagen
