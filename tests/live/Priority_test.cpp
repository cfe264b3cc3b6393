#include "live/Priority.h"
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <thread>

namespace hagen::live {
namespace {

struct Scheduling {
    int policy, priority;
};

/// Priority of a thread after lowerPriority(); policy -1 if real-time priority is not permitted.
Scheduling after(Scheduling before) {
    Scheduling result{-1, 0};
    std::thread([&] {
        sched_param priority{};
        priority.sched_priority = before.priority;
        if (pthread_setschedparam(pthread_self(), before.policy, &priority) != 0) return;
        lowerPriority();
        pthread_getschedparam(pthread_self(), &result.policy, &priority);
        result.priority = priority.sched_priority;
    }).join();
    return result;
}

TEST(Priority, LowersRealTimePriority) {
    const Scheduling fifo = after({SCHED_FIFO, 10});
    if (fifo.policy < 0) GTEST_SKIP() << "real-time priorities are not permitted";
    EXPECT_EQ(fifo.policy, SCHED_FIFO);
    EXPECT_EQ(fifo.priority, 9);
    EXPECT_EQ(after({SCHED_RR, 2}).priority, 1);
    EXPECT_EQ(after({SCHED_RR, 1}).priority, 1);  // already the minimum
}

TEST(Priority, KeepsOtherThreads) {
    const Scheduling other = after({SCHED_OTHER, 0});
    EXPECT_EQ(other.policy, SCHED_OTHER);
    EXPECT_EQ(other.priority, 0);
}

}  // namespace
}  // namespace hagen::live
