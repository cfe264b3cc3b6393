#include <gtest/gtest.h>
#include <hagen/autopilot/ClockOffset.h>

#include <random>

namespace hagen::autopilot {
namespace {

TEST(ClockOffset, TheFastestMessageTellsTheOffset) {
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
            EXPECT_NEAR(result.time_s, stamp_s + 70.005, 0.002) << i;
        }
    }
}

TEST(ClockOffset, FollowsAClockThatDrifts) {
    ClockOffset clock;
    for (int i = 0; i < 5000; ++i) {
        const double stamp_s = 0.02 * i;
        const double arrival_s = 10 + stamp_s * 1.0005 + 0.005;  // ours is faster by 500 ppm
        const auto result = clock.ourTime(stamp_s, arrival_s);
        EXPECT_FALSE(result.has_restarted);
        EXPECT_LE(result.time_s, arrival_s);
        EXPECT_GE(result.time_s, arrival_s - 0.0055);  // ten seconds of drift
    }
}

TEST(ClockOffset, AVehicleThatStartsAgainIsNoticed) {
    ClockOffset clock;
    EXPECT_FALSE(clock.ourTime(500, 600).has_restarted);
    EXPECT_FALSE(clock.ourTime(500.9, 600.9).has_restarted);
    const auto result = clock.ourTime(2, 603);
    EXPECT_TRUE(result.has_restarted);
    EXPECT_EQ(result.time_s, 603);
    EXPECT_FALSE(clock.ourTime(2.1, 603.1).has_restarted);
    EXPECT_TRUE(clock.ourTime(100, 603.2).has_restarted);  // a clock that is set
}

TEST(ClockOffset, MessagesThatWaitedAreOld) {
    // 50 per second, but whatever is stamped within some time arrives at its end, at once.
    for (const double wait_s : {1.2, 4.0, 30.0}) {
        ClockOffset clock;
        const double free_at_s = 10 + wait_s;
        for (int i = 0; i < 4000; ++i) {
            // As of two kinds of message, of which one is stamped a little earlier.
            const double stamp_s = 0.02 * i - (i % 2 == 0 ? 0.03 : 0.0);
            const bool waits = stamp_s > 10 && stamp_s < free_at_s;
            const double arrival_s = 70.005 + (waits ? free_at_s : stamp_s);
            const auto result = clock.ourTime(stamp_s, arrival_s);
            EXPECT_FALSE(result.has_restarted) << stamp_s;
            EXPECT_NEAR(result.time_s, stamp_s + 70.005, 1e-6);
        }
    }
}

TEST(ClockOffset, AClockThatStoodStillIsTakenUpWithinTenSeconds) {
    ClockOffset clock;
    int restarts = 0;
    for (int i = 0; i < 2000; ++i) {
        const double stamp_s = 0.02 * i;
        const double arrival_s = stamp_s + (stamp_s > 10 ? 100 : 70);  // paused for 30 s
        const auto result = clock.ourTime(stamp_s, arrival_s);
        EXPECT_LE(result.time_s, arrival_s + 1e-9);
        if (result.has_restarted) ++restarts;
        if (stamp_s > 20.1) {
            EXPECT_NEAR(result.time_s, arrival_s, 1e-6);
        }
    }
    EXPECT_EQ(restarts, 1);
}

}  // namespace
}  // namespace hagen::autopilot
