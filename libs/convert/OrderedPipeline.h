#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace hagen::convert {

/// The steps applied to each item of a stream. Steps marked "in order" process one item at a time,
/// in the order of reading; the other steps may process several items concurrently. An exception in
/// a step ends the stream before its item: earlier items are completed, unless packing or writing
/// failed, and no later item is accounted for.
template <class Item>
struct PipelineSteps {
    std::function<bool(Item&)> read;  ///< in order; returns false after the last item
    std::function<void(Item&)> work;
    std::function<void(Item&)> account;  ///< in order
    std::function<void(Item&)> pack;
    std::function<void(Item&)> write;  ///< in order
};

/// The result of a pipeline.
struct PipelineEnd {
    std::size_t threads;     ///< number of threads started
    std::exception_ptr why;  ///< exception of the first failed item; null at the end of the input
};

/// Admits items one by one, in the order of their numbers.
class Turnstile {
 public:
    template <class Step>
    void pass(std::size_t number, const Step& step) {
        std::unique_lock lock(mutex_);
        turn_.wait(lock, [&] { return next_ == number; });
        step();
        ++next_;
        turn_.notify_all();
    }

 private:
    std::mutex mutex_;
    std::condition_variable turn_;
    std::size_t next_ = 0;
};

/// A pipeline in progress. Each thread takes items through all steps, one by one.
template <class Item>
class OrderedPipeline {
 public:
    explicit OrderedPipeline(const PipelineSteps<Item>& steps) : steps_(steps) {}

    void run() {
        attempt([&] {
            for (Item item; takeOne(item);) {
            }
        });
    }
    std::exception_ptr why() const { return why_; }

 private:
    bool takeOne(Item& item) {
        std::size_t number = 0;
        std::exception_ptr failure;
        {
            const std::lock_guard lock(reading_);
            if (has_ended_) return false;
            try {
                if (!steps_.read(item)) has_ended_ = true;
            } catch (...) {
                failure = std::current_exception();
            }
            if (has_ended_) return false;
            has_ended_ = failure != nullptr;
            number = read_++;
        }
        try {
            if (!failure) steps_.work(item);
        } catch (...) {
            failure = std::current_exception();
        }
        bool is_accounted = false;
        accounts_.pass(number, [&] {
            if (has_failed_) return;
            is_accounted = attempt([&] {
                if (failure) std::rethrow_exception(failure);
                steps_.account(item);
            });
        });
        const bool is_packed = is_accounted && attempt([&] { steps_.pack(item); });
        writes_.pass(number, [&] {
            if (!is_cut_) is_cut_ = !is_packed || !attempt([&] { steps_.write(item); });
        });
        return true;
    }

    /// Returns false, and ends the pipeline, if a step throws. Keeps the first exception.
    template <class Step>
    bool attempt(const Step& step) {
        try {
            step();
            return true;
        } catch (...) {
            const std::lock_guard lock(failing_);
            if (!why_) why_ = std::current_exception();
        }
        has_failed_ = has_ended_ = true;
        return false;
    }

    const PipelineSteps<Item>& steps_;
    std::mutex reading_, failing_;
    std::size_t read_ = 0;
    std::atomic<bool> has_ended_{false};   ///< reading has stopped
    std::atomic<bool> has_failed_{false};  ///< accounting has stopped
    bool is_cut_ = false;                  ///< writing has stopped
    std::exception_ptr why_;
    Turnstile accounts_, writes_;
};

/// Runs all items through the steps on up to `threads` threads, including the caller's, or on fewer
/// if the system cannot start more (oneTBB would terminate the process). Holds one item per thread
/// in memory.
template <class Item>
PipelineEnd runPipeline(const PipelineSteps<Item>& steps, std::size_t threads) {
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
    return {1 + others.size(), pipeline.why()};
}

}  // namespace hagen::convert
