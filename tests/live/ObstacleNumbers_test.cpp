#include "live/autopilot/ObstacleNumbers.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>

namespace hagen::live {
namespace {

struct Seen {
    std::size_t k;
    double distance_m;
};

Directions directionsOf(const std::vector<Seen>& all) {
    Directions directions;
    for (const Seen& seen : all) {
        const double clockwise_rad = radians(5.0 * static_cast<double>(seen.k));
        Direction& direction = directions[seen.k];
        direction.state = DirectionState::Obstacle;
        direction.distance_m = static_cast<float>(seen.distance_m);
        direction.at_m = Eigen::Vector3d(seen.distance_m * std::cos(clockwise_rad),
                                         -seen.distance_m * std::sin(clockwise_rad), 0.5)
                             .cast<float>();
    }
    return directions;
}

TEST(ObstacleNumbers, MergesNeighboursWithinOneMetre) {
    ObstacleNumbers numbers;
    // One obstacle near 0 degrees, one at 90 degrees, and two neighbours 3 m apart.
    const auto found = numbers.nearest(
        directionsOf({{71, 5.2}, {0, 5}, {1, 5.1}, {18, 8}, {40, 6}, {41, 9}}), 10, {});
    ASSERT_EQ(found.size(), 4u);
    EXPECT_NEAR(found[0].at_m.x(), 5, 1e-5);
    EXPECT_NEAR(found[0].at_m.z(), 0.5, 1e-5);
    EXPECT_NEAR(found[1].at_m.norm(), std::hypot(6, 0.5), 1e-4);
    EXPECT_NEAR(found[2].at_m.y(), -8, 1e-4);
    EXPECT_NEAR(found[3].at_m.norm(), std::hypot(9, 0.5), 1e-4);
}

TEST(ObstacleNumbers, RoomIsSingleObstacle) {
    std::vector<Seen> all;
    for (std::size_t k = 0; k < 72; ++k) all.push_back({k, k == 50 ? 3.8 : 4.0});
    ObstacleNumbers numbers;
    const auto found = numbers.nearest(directionsOf(all), 5, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].at_m.head<2>().norm(), 3.8, 1e-5);
}

TEST(ObstacleNumbers, NumberFollowsSlowObstacle) {
    ObstacleNumbers numbers;
    const auto first = numbers.nearest(directionsOf({{0, 5}, {18, 8}, {40, 6}}), 10, {});
    // The obstacles approach, and their order by distance changes.
    const auto second = numbers.nearest(directionsOf({{0, 7.0 - 1}, {18, 6.6}, {40, 5.5}}), 10, {});
    ASSERT_EQ(second.size(), 3u);
    EXPECT_EQ(second[0].number, first[1].number);
    EXPECT_EQ(second[1].number, first[0].number);
    EXPECT_EQ(second[2].number, first[2].number);
    // Another obstacle at another position.
    const auto third = numbers.nearest(directionsOf({{60, 5}}), 10, {});
    for (const Obstacle& obstacle : second) EXPECT_NE(third[0].number, obstacle.number);
}

TEST(ObstacleNumbers, TurningVehicleKeepsNumbers) {
    ObstacleNumbers numbers;
    VehiclePose pose;
    const auto first = numbers.nearest(directionsOf({{0, 8}, {6, 8}}), 10, pose);
    // The vehicle turns clockwise by 30 degrees: obstacles on the right are now ahead.
    pose.map_from_vehicle = Eigen::AngleAxisd(radians(-30), Eigen::Vector3d::UnitZ());
    const auto second = numbers.nearest(directionsOf({{66, 8}, {0, 8.1}}), 10, pose);
    ASSERT_EQ(second.size(), 2u);
    EXPECT_NEAR(second[0].at_m.y(), 4, 1e-4);  // the obstacle on the left
    EXPECT_EQ(second[0].number, first[0].number);
    EXPECT_EQ(second[1].number, first[1].number);
}

TEST(ObstacleNumbers, ReturnsNearestOnly) {
    ObstacleNumbers numbers;
    const auto found = numbers.nearest(directionsOf({{0, 5}, {18, 8}, {40, 6}}), 2, {});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_LT(found[0].at_m.norm(), found[1].at_m.norm());
    EXPECT_TRUE(numbers.nearest(Directions(), 5, {}).empty());
}

TEST(ObstacleNumbers, SkipsReservedNumber) {
    ObstacleNumbers numbers;
    for (int i = 0; i < 70000; ++i) {
        const auto found = numbers.nearest(directionsOf({{i % 2 == 0 ? 0u : 36u, 5}}), 1, {});
        ASSERT_NE(found[0].number, 65535);
    }
}

}  // namespace
}  // namespace hagen::live
