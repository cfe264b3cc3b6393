#include <gtest/gtest.h>
#include <hagen/avoidance/WindowSize.h>
#include <hagen/avoidance/WorldModel.h>

namespace hagen::avoidance {
namespace {

FlightPace paceOf(double speed_m_s) { return {speed_m_s, 0.1, {}}; }

/// Time and distance to brake to 2 % of a speed or 0.1 m/s, in control steps.
struct Braking {
    double time_s = 0, way_m = 0;
};
Braking brakingFrom(double speed_m_s) {
    VehicleState state{{0, 0, 0}, {speed_m_s, 0, 0}};
    Braking braking;
    while (state.velocity_m_s.x() > std::max(0.1, 0.02 * speed_m_s)) {
        state = advance(state, Eigen::Vector3d::Zero(), kControlStep_s, {});
        braking.time_s += kControlStep_s;
    }
    braking.way_m = state.position_m.x();
    return braking;
}

TEST(WindowSize, MatchesDocumentedSpeeds) {
    EXPECT_EQ(windowSizeFor(paceOf(2)).scans, 7u);
    EXPECT_EQ(windowSizeFor(paceOf(4)).scans, 11u);
    EXPECT_EQ(windowSizeFor(paceOf(10)).scans, 23u);
    EXPECT_EQ(windowSizeFor(paceOf(14)).scans, 31u);
    EXPECT_FLOAT_EQ(windowSizeFor(paceOf(2)).radius_m, 15);
    EXPECT_FLOAT_EQ(windowSizeFor(paceOf(4)).radius_m, 15);
    EXPECT_FLOAT_EQ(windowSizeFor(paceOf(10)).radius_m, 27.5f);
    EXPECT_FLOAT_EQ(windowSizeFor(paceOf(14)).radius_m, 42.9f);
    EXPECT_FLOAT_EQ(windowSizeFor(paceOf(30)).radius_m, 50);
}

TEST(WindowSize, PerceptionRangeCoversWindow) {
    EXPECT_FLOAT_EQ(perceptionRangeFor_m(paceOf(4)), 20);
    EXPECT_FLOAT_EQ(perceptionRangeFor_m(paceOf(8)), windowSizeFor(paceOf(8)).radius_m);
    EXPECT_FLOAT_EQ(perceptionRangeFor_m(paceOf(10)), 27.5f);
}

TEST(WindowSize, CoversStoppingTime) {
    for (double speed_m_s = 2; speed_m_s <= 14; speed_m_s += 0.5) {
        const FlightPace pace = paceOf(speed_m_s);
        const WindowSize size = windowSizeFor(pace);
        // Below 1 m/s, braking takes longer, but is uncritical.
        const double needed_s = pace.reaction_s() + brakingFrom(speed_m_s).time_s - 0.4;
        EXPECT_GE(0.1 * static_cast<double>(size.scans), needed_s) << speed_m_s;
        EXPECT_LE(0.1 * static_cast<double>(size.scans), needed_s + 0.5) << speed_m_s;
    }
}

TEST(WindowSize, CoversPlanAndClearance) {
    constexpr double kLookAhead_s = 1.2;
    for (double speed_m_s = 6; speed_m_s <= 14; speed_m_s += 0.5) {
        const FlightPace pace = paceOf(speed_m_s);
        const double planned_m = speed_m_s * (pace.reaction_s() + kLookAhead_s) +
                                 brakingFrom(speed_m_s).way_m +
                                 static_cast<double>(WorldModel::kReach_m);
        EXPECT_NEAR(static_cast<double>(windowSizeFor(pace).radius_m), planned_m, 0.3) << speed_m_s;
    }
}

TEST(WindowSize, DependsOnScanPeriod) {
    FlightPace pace = paceOf(4);
    pace.scan_period_s = 0.05;  // at 20 Hz, the vehicle reacts 0.1 s earlier
    EXPECT_EQ(windowSizeFor(pace).scans, 19u);
    pace.limits.acceleration_m_s2 = 10;
    EXPECT_EQ(windowSizeFor(pace).scans, 11u);
}

}  // namespace
}  // namespace hagen::avoidance
