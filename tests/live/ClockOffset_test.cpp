#include "live/autopilot/ClockOffset.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hagen::live {
namespace {

TEST(ClockOffset, FastestMessageSetsOffset) {
    // The vehicle's clock is 70 s behind ours; messages take 5 to 45 ms.
    ClockOffset clock;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> delay_s(0.005, 0.045);
    for (int i = 0; i < 2000; ++i) {
        const double stamp_s = 3 + 0.02 * i, arrival_s = stamp_s + 70 + delay_s(random);
        const auto result = clock.ourTime(stamp_s, arrival_s);
        EXPECT_FALSE(result.has_restarted);
        EXPECT_LE(result.time_s, arrival_s);
        if (i > 200) {
            EXPECT_NEAR(result.time_s, stamp_s + 70.005, 0.005) << i;
        }
    }
}

TEST(ClockOffset, FollowsDriftingClock) {
    ClockOffset clock;
    for (int i = 0; i < 5000; ++i) {
        const double stamp_s = 0.02 * i;
        const double arrival_s = 10 + stamp_s * 1.0005 + 0.005;  // our clock is fast by 500 ppm
        const auto result = clock.ourTime(stamp_s, arrival_s);
        EXPECT_FALSE(result.has_restarted);
        EXPECT_LE(result.time_s, arrival_s);
        EXPECT_GE(result.time_s, arrival_s - 0.0055);  // 10 s of drift
    }
}

TEST(ClockOffset, DetectsRestartWithinOneSecond) {
    ClockOffset clock;
    EXPECT_FALSE(clock.ourTime(500, 600).has_restarted);
    EXPECT_FALSE(clock.ourTime(500.9, 600.9).has_restarted);
    int restarts = 0;
    for (int i = 0; i < 100; ++i) {
        const auto result = clock.ourTime(2 + 0.02 * i, 603 + 0.02 * i);
        if (result.has_restarted) ++restarts;
        // Until the restart is detected, messages seem older than the previous ones.
        EXPECT_LT(result.time_s, restarts > 0 ? 605 : 600);
        EXPECT_EQ(restarts, 0.02 * i > 0.49 ? 1 : 0) << i;
    }
}

TEST(ClockOffset, FollowsClockStepAfterSeveralStamps) {
    for (const double ahead_s : {0.5, 1000.0}) {
        ClockOffset clock;
        int restarts = 0;
        for (int i = 0; i < 400; ++i) {
            const double stamp_s = 0.02 * i + (i >= 300 || i % 100 == 50 ? ahead_s : 0);
            const auto result = clock.ourTime(stamp_s, 70 + 0.02 * i);
            if (result.has_restarted) ++restarts;
            EXPECT_NEAR(result.time_s, 70 + 0.02 * i, 1e-4) << i;
            EXPECT_EQ(restarts, ahead_s > 1 && i >= 302 ? 1 : 0);
        }
    }
}

/// The first time stamp after the restart may be later or earlier than the last one before it.
TEST(ClockOffset, FollowsRestartAfterLongGap) {
    for (const double uptime_s : {5.0, 11.5, 12.0, 15.0, 25.0}) {
        ClockOffset clock;
        for (double stamp_s = 3; stamp_s < 12; stamp_s += 0.02) clock.ourTime(stamp_s, stamp_s);
        for (int i = 0; i < 1000; ++i) {
            const double arrival_s = 37 + 0.02 * i;
            const auto result = clock.ourTime(uptime_s + 0.02 * i, arrival_s);
            EXPECT_LE(result.time_s, arrival_s);
            if (i > 510) {
                EXPECT_NEAR(result.time_s, arrival_s, 1e-6) << uptime_s;
            }
        }
    }
}

/// Two paths lead to the vehicle; the fast one fails.
TEST(ClockOffset, MessagesOnSlowerPathAreOld) {
    for (const double longer_s : {0.8, 1.5, 2.0, 10.0}) {
        ClockOffset clock;
        for (double stamp_s = 0; stamp_s < 560; stamp_s += 0.02) {
            clock.ourTime(stamp_s, stamp_s + 70);
        }
        for (double stamp_s = 560 - longer_s; stamp_s < 600; stamp_s += 0.02) {
            const auto result = clock.ourTime(stamp_s, stamp_s + 70 + longer_s);
            EXPECT_FALSE(result.has_restarted);
            ASSERT_LE(result.time_s, stamp_s + 70.1);
        }
    }
}

TEST(ClockOffset, SingleMessagesOnSlowerPathAreOld) {
    ClockOffset clock;
    for (int i = 0; i < 3000; ++i) {
        const double stamp_s = 0.02 * i, arrival_s = stamp_s + 70;
        EXPECT_FALSE(clock.ourTime(stamp_s, arrival_s).has_restarted);
        if (i % 100 != 99) continue;
        for (int late = 1; late <= 5; ++late) {
            const double old_s = stamp_s - 1.5 + 0.02 * late;
            const auto result = clock.ourTime(old_s, arrival_s + 0.001);
            EXPECT_FALSE(result.has_restarted);
            EXPECT_NEAR(result.time_s, old_s + 70, 0.002);
        }
    }
}

TEST(ClockOffset, DrainingBacklogIsOld) {
    // Messages at 50 Hz, then an outage, then a backlog that drains faster than messages are sent.
    for (const double speed : {1.1, 1.5, 2.0, 4.0}) {
        ClockOffset clock;
        double free_s = 0;
        for (int i = 0; i < 20000; ++i) {
            const double stamp_s = 0.02 * i;
            const bool waits = stamp_s > 10 && stamp_s <= 40;
            double arrival_s = std::max(70 + (waits ? 40 : stamp_s), free_s);
            free_s = arrival_s + 0.02 / speed;
            const auto result = clock.ourTime(stamp_s, arrival_s);
            EXPECT_FALSE(result.has_restarted) << stamp_s;
            ASSERT_LE(result.time_s, stamp_s + 70.4) << speed;  // our clock may drift
        }
    }
}

TEST(ClockOffset, MessagesFromFullQueueAreOld) {
    for (const bool after_outage : {false, true}) {
        ClockOffset clock;
        for (int i = 0; i < 5000; ++i) {
            const double stamp_s = 0.02 * i;
            double arrival_s = stamp_s + 70;
            if (stamp_s > 10) arrival_s += std::min(0.5 * (stamp_s - 10), 2.0);
            if (after_outage && stamp_s > 10) {
                // First, messages from the outage arrive, then all messages are 2 s late.
                if (stamp_s > 10.5 && stamp_s <= 38) continue;
                arrival_s = std::max(stamp_s + 72, 110 + 0.001 * (stamp_s - 10));
            }
            EXPECT_LE(clock.ourTime(stamp_s, arrival_s).time_s, stamp_s + 70.1) << stamp_s;
        }
    }
}

TEST(ClockOffset, DelayedMessagesAreOld) {
    // At 50 Hz, all messages stamped during an interval arrive together at its end.
    for (const double wait_s : {1.2, 4.0, 30.0}) {
        ClockOffset clock;
        const double free_at_s = 10 + wait_s;
        for (int i = 0; i < 4000; ++i) {
            // Two message types, one of them stamped slightly earlier.
            const double stamp_s = 0.02 * i - (i % 2 == 0 ? 0.03 : 0.0);
            const bool waits = stamp_s > 10 && stamp_s < free_at_s;
            const double arrival_s = 70.005 + (waits ? free_at_s : stamp_s);
            const auto result = clock.ourTime(stamp_s, arrival_s);
            EXPECT_FALSE(result.has_restarted) << stamp_s;
            EXPECT_NEAR(result.time_s, stamp_s + 70.02, 0.016);  // our clock may drift
        }
    }
}

/// A paused simulation looks like a link that was blocked and stays late.
TEST(ClockOffset, FollowsPausedSimulation) {
    for (const bool is_simulated : {false, true}) {
        ClockOffset clock(is_simulated);
        for (int i = 0; i < 6000; ++i) {
            const double stamp_s = 100 + 0.02 * i;
            const double arrival_s = stamp_s + (i > 500 ? 100 : 70);  // paused for 30 s
            const auto result = clock.ourTime(stamp_s, arrival_s);
            EXPECT_LE(result.time_s, arrival_s);
            if (i > 1100) {
                EXPECT_NEAR(result.time_s, is_simulated ? arrival_s : stamp_s + 70, 0.2);
            }
        }
    }
}

TEST(ClockOffset, FollowsSlowSimulation) {
    for (const double rate : {0.6, 0.9, 0.995}) {
        ClockOffset clock(true);
        for (int i = 0; i < 20000; ++i) {
            const double arrival_s = 0.02 * i;
            const auto result = clock.ourTime(rate * arrival_s, arrival_s);
            EXPECT_FALSE(result.has_restarted);
            EXPECT_NEAR(result.time_s, arrival_s, 1e-6);
        }
    }
}

}  // namespace
}  // namespace hagen::live
