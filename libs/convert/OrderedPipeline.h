#pragma once
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace hagen::convert {

/// Cores that this process may use.
inline std::size_t coreCount() {
    const unsigned cores = std::thread::hardware_concurrency();
    return cores == 0 ? 1 : cores;
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

/// A step that items take one by one, in the order of their numbers.
class Turnstile {
 public:
    /// Waits for the turn of an item and does its step. False, without doing it, once closed.
    template <class Step>
    bool pass(std::size_t number, const Step& step) {
        std::unique_lock lock(mutex_);
        turn_.wait(lock, [&] { return next_ == number || is_closed_; });
        if (is_closed_) return false;
        step();
        ++next_;
        turn_.notify_all();
        return true;
    }
    void close() {
        const std::lock_guard lock(mutex_);
        is_closed_ = true;
        turn_.notify_all();
    }

 private:
    std::mutex mutex_;
    std::condition_variable turn_;
    std::size_t next_ = 0;
    bool is_closed_ = false;
};

/// A pipeline in progress. Each thread takes one item after the other through all steps.
template <class Item>
class OrderedPipeline {
 public:
    explicit OrderedPipeline(const PipelineSteps<Item>& steps) : steps_(steps) {}

    void run() {
        try {
            for (Item item; takeOne(item);) {
            }
        } catch (...) {
            endWith(std::current_exception());
        }
    }

    /// Ends the pipeline with an exception of one of its steps; the first is kept.
    void endWith(std::exception_ptr why) {
        {
            const std::lock_guard lock(reading_);
            is_at_end_ = true;
            if (!why_) why_ = std::move(why);
        }
        accounts_.close();
        writes_.close();
    }
    void rethrow() const {
        if (why_) std::rethrow_exception(why_);
    }

 private:
    bool takeOne(Item& item) {
        std::size_t number = 0;
        {
            const std::lock_guard lock(reading_);
            if (is_at_end_) return false;
            is_at_end_ = true;  // also if reading throws
            if (!steps_.read(item)) return false;
            is_at_end_ = false;
            number = read_++;
        }
        steps_.work(item);
        if (!accounts_.pass(number, [&] { steps_.account(item); })) return false;
        steps_.pack(item);
        return writes_.pass(number, [&] { steps_.write(item); });
    }

    const PipelineSteps<Item>& steps_;
    std::mutex reading_;
    std::size_t read_ = 0;
    bool is_at_end_ = false;
    std::exception_ptr why_;
    Turnstile accounts_, writes_;
};

/// Runs all items through the steps on up to `threads` threads, the caller's among them: fewer if
/// the system refuses some (oneTBB, which would do the same, ends the process then). Returns their
/// number. An exception in a step ends the pipeline and is rethrown; items before it may or may not
/// be written then. Holds an item per thread in memory.
template <class Item>
std::size_t runPipeline(const PipelineSteps<Item>& steps, std::size_t threads) {
    OrderedPipeline<Item> pipeline(steps);
    std::vector<std::thread> others;
    try {
        others.reserve(threads);
        while (others.size() + 1 < threads) others.emplace_back([&] { pipeline.run(); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    pipeline.run();
    for (std::thread& other : others) other.join();
    pipeline.rethrow();
    return 1 + others.size();
}

}  // namespace hagen::convert
