#include <gtest/gtest.h>
#include <hagen/avoidance/Vehicle.h>

namespace hagen::avoidance {
namespace {

TEST(Vehicle, AcceleratesWithinLimits) {
    const VehicleLimits limits;
    const Eigen::Vector3d hard = accelerationFor({}, {8, 6, 0}, limits);
    EXPECT_TRUE(hard.isApprox(Eigen::Vector3d(4, 3, 0)));
    const Eigen::Vector3d soft = accelerationFor({}, {0.5, 0, 0}, limits);
    EXPECT_TRUE(soft.isApprox(Eigen::Vector3d(2.5, 0, 0)));
}

TEST(Vehicle, StoppingDistanceMatchesPhysics) {
    const VehicleLimits limits;
    VehicleState state{{0, 0, 2}, {4, 0, 0}};
    for (int step = 0; step < 200; ++step) {
        state = advance(state, {0, 0, 0}, kControlStep_s, limits);
    }
    // Braking at 5 m/s^2 to 1 m/s, then exponentially with 5/s: (16 - 1) / 10 + 1 / 5 m.
    EXPECT_NEAR(state.position_m.x(), 1.7, 0.02);
    EXPECT_NEAR(state.velocity_m_s.norm(), 0, 1e-6);
}

TEST(CommandQueue, FollowsCommandsOnTime) {
    CommandQueue commands;
    commands.add(0.113, {4, 0, 0});
    commands.add(0.5, {0, 0, 0});
    EXPECT_EQ(commands.at(0.1), Eigen::Vector3d::Zero());
    EXPECT_EQ(commands.at(0.2), Eigen::Vector3d(4, 0, 0));
    EXPECT_EQ(commands.at(0.6), Eigen::Vector3d::Zero());
    const VehicleLimits limits;
    const VehicleState before = commands.advanced(VehicleState{}, 0, 0.113, limits);
    EXPECT_EQ(before.velocity_m_s.x(), 0);
    // Saturated at 5 m/s^2 for exactly 0.2 s.
    const VehicleState after = commands.advanced(VehicleState{}, 0, 0.313, limits);
    EXPECT_NEAR(after.velocity_m_s.x(), 1.0, 1e-12);
    EXPECT_NEAR(after.position_m.x(), 0.5 * 5 * 0.04, 1e-12);
}

TEST(CommandQueue, ForgettingKeepsFutureCommands) {
    CommandQueue all, some;
    for (CommandQueue* commands : {&all, &some}) {
        commands->add(0.1, {1, 0, 0});
        commands->add(0.2, {0, 2, 0});
        commands->add(0.3, {0, 0, 1});
    }
    some.forgetBefore(0.25);
    const VehicleLimits limits;
    const VehicleState a = all.advanced(VehicleState{}, 0.25, 0.7, limits);
    const VehicleState b = some.advanced(VehicleState{}, 0.25, 0.7, limits);
    EXPECT_EQ(a.position_m, b.position_m);
    EXPECT_EQ(a.velocity_m_s, b.velocity_m_s);
}

}  // namespace
}  // namespace hagen::avoidance
