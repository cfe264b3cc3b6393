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

}  // namespace
}  // namespace hagen::autopilot
