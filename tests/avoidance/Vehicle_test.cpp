#include <gtest/gtest.h>
#include <hagen/avoidance/Vehicle.h>

namespace hagen::avoidance {
namespace {

TEST(Vehicle, AcceleratesTowardsTheCommandWithinItsLimits) {
    const VehicleLimits limits;
    const Eigen::Vector3d hard = accelerationFor({}, {8, 6, 0}, limits);
    EXPECT_TRUE(hard.isApprox(Eigen::Vector3d(4, 3, 0)));
    const Eigen::Vector3d soft = accelerationFor({}, {0.5, 0, 0}, limits);
    EXPECT_TRUE(soft.isApprox(Eigen::Vector3d(2.5, 0, 0)));
}

TEST(Vehicle, StopsAfterTheWayThatPhysicsTells) {
    const VehicleLimits limits;
    VehicleState state{{0, 0, 2}, {4, 0, 0}};
    for (int step = 0; step < 200; ++step) {
        state = advance(state, {0, 0, 0}, kControlStep_s, limits);
    }
    // At 5 m/s^2 down to 1 m/s, then by 1/5 s: (16 - 1) / 10 + 1 / 5 m.
    EXPECT_NEAR(state.position_m.x(), 1.7, 0.02);
    EXPECT_NEAR(state.velocity_m_s.norm(), 0, 1e-6);
}

TEST(Vehicle, AStepOfNothingChangesNothing) {
    const VehicleState state{{1, 2, 3}, {4, 5, 6}};
    const VehicleState same = advance(state, {0, 0, 0}, 0, {});
    EXPECT_EQ(same.position_m, state.position_m);
    EXPECT_EQ(same.velocity_m_s, state.velocity_m_s);
}

}  // namespace
}  // namespace hagen::avoidance
