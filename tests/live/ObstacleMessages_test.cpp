#include "live/autopilot/ObstacleMessages.h"
#include <gtest/gtest.h>

#include "live/Vehicle.h"

namespace hagen::live {
namespace {

using State = DirectionState;

TEST(ObstacleDistance, EncodesDistancesNothingAndUnknown) {
    Directions directions;
    directions[0] = {State::Obstacle, 7.999f, Eigen::Vector3f::Zero()};
    directions[1].state = State::SeenNothing;
    directions[3] = {State::Obstacle, 0.001f, Eigen::Vector3f::Zero()};
    directions[4] = {State::Obstacle, 23, Eigen::Vector3f::Zero()};
    const auto message = obstacleDistance(directions, {20, 0.5f}, 12.5);
    EXPECT_EQ(message.distances[0], 799);   // rounded down
    EXPECT_EQ(message.distances[1], 2001);  // nothing
    EXPECT_EQ(message.distances[2], 65535);
    EXPECT_EQ(message.distances[3], message.min_distance);
    EXPECT_EQ(message.distances[4], 2000);  // an obstacle must never be encoded as "nothing"
    EXPECT_EQ(message.min_distance, 1);
    EXPECT_EQ(message.max_distance, 2000);
    EXPECT_EQ(message.increment, 5);
    EXPECT_EQ(message.increment_f, 5);
    EXPECT_EQ(message.angle_offset, 0);
    EXPECT_EQ(message.frame, 12);
    EXPECT_EQ(message.sensor_type, 0);
    EXPECT_EQ(message.time_usec, 12500000u);
}

TEST(ObstacleDistance, LongZoneKeepsReservedValues) {
    const auto message = obstacleDistance({}, {1000, 0.5f}, 0);
    EXPECT_EQ(message.max_distance, 65533);
}

TEST(ObstacleDistance3d, IsInTiltedBodyFrame) {
    Vehicle vehicle;
    vehicle.roll_rad = 0.3;
    vehicle.pitch_rad = -0.2;
    vehicle.yaw_rad = 2;
    const Eigen::Vector3d place_ned(5, 3, -1);
    VehicleMotion motion;
    motion.take(vehicle.attitude(1), 1);
    const auto pose = motion.at(1);
    const Eigen::Vector3d level = levelFromVehicle(*pose) * vehicle.seen(place_ned);
    const auto messages = obstacleDistances3d({{42, level.cast<float>()}}, pose, {20, 0.5f}, 3);
    ASSERT_EQ(messages.size(), 1u);
    const Eigen::Vector3d frd = vehicle.nedFromFrd().transpose() * place_ned;
    EXPECT_NEAR(messages[0].x, frd.x(), 1e-4);
    EXPECT_NEAR(messages[0].y, frd.y(), 1e-4);
    EXPECT_NEAR(messages[0].z, frd.z(), 1e-4);
    EXPECT_EQ(messages[0].obstacle_id, 42);
    EXPECT_EQ(messages[0].frame, 12);
    EXPECT_EQ(messages[0].time_boot_ms, 3000u);
    EXPECT_EQ(messages[0].min_distance, 0.5f);
    EXPECT_EQ(messages[0].max_distance, 20);
}

TEST(ObstacleDistance3d, FlipsAxesWithoutAttitude) {
    const auto messages = obstacleDistances3d({{1, {4, 2, 1}}}, {}, {20, 0.5f}, 3);
    EXPECT_EQ(messages[0].x, 4);
    EXPECT_EQ(messages[0].y, -2);
    EXPECT_EQ(messages[0].z, -1);
}

TEST(DistanceBelow, LooksDown) {
    const auto message = distanceBelow(2.345f, {20, 0.5f}, 3);
    EXPECT_EQ(message.current_distance, 234);
    EXPECT_EQ(message.min_distance, 50);
    EXPECT_EQ(message.max_distance, 4000);
    EXPECT_EQ(message.orientation, 25);
    EXPECT_EQ(message.covariance, 255);
    EXPECT_EQ(message.time_boot_ms, 3000u);
    EXPECT_EQ(distanceBelow(80, {20, 0.5f}, 3).current_distance, 4001);
}

TEST(Heartbeat, IsFromOnboardComputer) {
    const auto message = heartbeat(mavlink::kStateCritical);
    EXPECT_EQ(message.type, 18);
    EXPECT_EQ(message.autopilot, 8);
    EXPECT_EQ(message.system_status, 5);
    EXPECT_EQ(message.mavlink_version, 3);
}

}  // namespace
}  // namespace hagen::live
