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

inline std::size_t coreCount() {
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
struct PipelineSlot {
    Item item;
    std::mutex lock;
    ~PipelineSlot() { const std::lock_guard last(lock); }
};

/// A pool of reusable slots.
template <class Item>
class PipelineSlots {
 public:
    using Slot = PipelineSlot<Item>;

    explicit PipelineSlots(std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) {
            giveBack(slots_.emplace_back(std::make_unique<Slot>()).get());
        }
    }
    ~PipelineSlots() { const std::lock_guard last(mutex_); }
    Slot* take() {
        const std::lock_guard lock(mutex_);
        Slot* const slot = idle_.back();
        idle_.pop_back();
        return slot;
    }
    void giveBack(Slot* slot) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(slot);
    }

 private:
    std::vector<std::unique_ptr<Slot>> slots_;
    std::vector<Slot*> idle_;
    std::mutex mutex_;
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
    const std::size_t max_items = 2 * threads;  // one in work, one waiting for its turn
    PipelineSlots<Item> slots(max_items);
    using Slot = PipelineSlot<Item>;

    std::mutex reads, accounts, writes;  // never contended either
    const auto read = [&](tbb::flow_control& flow) -> Slot* {
        Slot* const slot = slots.take();
        const std::scoped_lock lock(slot->lock, reads);
        if (steps.read(slot->item)) return slot;
        flow.stop();
        return nullptr;
    };
    const auto parallel = [](const auto& step) {
        return tbb::make_filter<Slot*, Slot*>(tbb::filter_mode::parallel, [&](Slot* slot) {
            const std::lock_guard lock(slot->lock);
            step(slot->item);
            return slot;
        });
    };
    const auto account = [&](Slot* slot) {
        const std::scoped_lock lock(slot->lock, accounts);
        steps.account(slot->item);
        return slot;
    };
    const auto write = [&](Slot* slot) {
        {
            const std::scoped_lock lock(slot->lock, writes);
            steps.write(slot->item);
        }
        slots.giveBack(slot);
    };
    constexpr auto in_order = tbb::filter_mode::serial_in_order;

    // TBB prints a warning if a pipeline has more threads than cores, unless this allows them.
    std::optional<tbb::global_control> more;
    if (threads > coreCount()) {
        more.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    tbb::task_arena(static_cast<int>(threads)).execute([&] {
        tbb::parallel_pipeline(
            max_items, tbb::make_filter<void, Slot*>(in_order, read) & parallel(steps.work) &
                           tbb::make_filter<Slot*, Slot*>(in_order, account) &
                           parallel(steps.pack) & tbb::make_filter<Slot*, void>(in_order, write));
    });
}

}  // namespace hagen::logs
