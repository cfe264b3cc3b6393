#include <gtest/gtest.h>
#include <hagen/avoidance/Vehicle.h>

namespace hagen::avoidance {
namespace {

TEST(CommandQueue, AVehicleWithoutCommandsStandsStill) {
    const CommandQueue commands;
    const avoidance::VehicleState state =
        commands.advanced({{1, 2, 3}, Eigen::Vector3d::Zero()}, 0, 1, avoidance::VehicleLimits{});
    EXPECT_EQ(state.position_m, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(state.velocity_m_s, Eigen::Vector3d::Zero());
}

TEST(CommandQueue, ACommandIsFollowedFromItsTimeOnAndNotBefore) {
    CommandQueue commands;
    commands.add(0.113, {4, 0, 0});
    commands.add(0.5, {0, 0, 0});
    EXPECT_EQ(commands.at(0.1), Eigen::Vector3d::Zero());
    EXPECT_EQ(commands.at(0.2), Eigen::Vector3d(4, 0, 0));
    EXPECT_EQ(commands.at(0.6), Eigen::Vector3d::Zero());
    const avoidance::VehicleLimits limits;
    const avoidance::VehicleState before =
        commands.advanced(avoidance::VehicleState{}, 0, 0.113, limits);
    EXPECT_EQ(before.velocity_m_s.x(), 0);
    // Saturated: 5 m/s^2 for 0.2 s, of which every millisecond counts.
    const avoidance::VehicleState after =
        commands.advanced(avoidance::VehicleState{}, 0, 0.313, limits);
    EXPECT_NEAR(after.velocity_m_s.x(), 1.0, 1e-12);
    EXPECT_NEAR(after.position_m.x(), 0.5 * 5 * 0.04, 1e-12);
}

TEST(CommandQueue, ForgettingChangesNothingAfterwards) {
    CommandQueue all, some;
    for (CommandQueue* commands : {&all, &some}) {
        commands->add(0.1, {1, 0, 0});
        commands->add(0.2, {0, 2, 0});
        commands->add(0.3, {0, 0, 1});
    }
    some.forgetBefore(0.25);
    const avoidance::VehicleLimits limits;
    const avoidance::VehicleState a = all.advanced(avoidance::VehicleState{}, 0.25, 0.7, limits);
    const avoidance::VehicleState b = some.advanced(avoidance::VehicleState{}, 0.25, 0.7, limits);
    EXPECT_EQ(a.position_m, b.position_m);
    EXPECT_EQ(a.velocity_m_s, b.velocity_m_s);
}

}  // namespace
}  // namespace hagen::avoidance
