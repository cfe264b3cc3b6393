#include "live/autopilot/ObstacleMessages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hagen::live {
namespace {

constexpr std::uint16_t kUnknown_cm = std::numeric_limits<std::uint16_t>::max();
constexpr float kMax_cm = 65533;  // 65534 is reserved for "nothing", 65535 for "unknown"
constexpr float kGroundReach_m = 40;
constexpr std::uint8_t kStep_deg = 5;
constexpr std::uint8_t kMavlinkVersion = 3;
constexpr std::uint8_t kUnknownVariance = 255;

/// Rounds down, to be on the safe side.
std::uint16_t centimetres(float metres, float min_cm, float max_cm) {
    return static_cast<std::uint16_t>(std::clamp(std::floor(100 * metres), min_cm, max_cm));
}

std::uint32_t milliseconds(double time_s) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(1e3 * time_s));
}

}  // namespace

mavlink::ObstacleDistance obstacleDistance(const Directions& directions, const Limits& limits,
                                           double time_s) {
    mavlink::ObstacleDistance message;
    message.time_usec = static_cast<std::uint64_t>(1e6 * time_s);
    message.sensor_type = mavlink::kDistanceSensorLaser;
    message.increment = kStep_deg;
    message.increment_f = kStep_deg;
    message.angle_offset = 0;
    message.frame = mavlink::kFrameBodyFrd;
    // Horizontal distances can be below the sensor's minimum range.
    message.min_distance = 1;
    message.max_distance = centimetres(limits.zone_m, 1, kMax_cm);
    for (std::size_t k = 0; k < directions.size(); ++k) {
        std::uint16_t& distance_cm = message.distances[k];
        switch (directions[k].state) {
            case DirectionState::Unknown:
                distance_cm = kUnknown_cm;
                break;
            case DirectionState::SeenNothing:
                distance_cm = static_cast<std::uint16_t>(message.max_distance + 1);
                break;
            case DirectionState::Obstacle:
                distance_cm = centimetres(directions[k].distance_m, 1, message.max_distance);
                break;
        }
    }
    return message;
}

std::vector<mavlink::ObstacleDistance3d> obstacleDistances3d(const std::vector<Obstacle>& obstacles,
                                                             const std::optional<VehiclePose>& pose,
                                                             const Limits& limits, double time_s) {
    Eigen::Matrix3f vehicle_from_level = Eigen::Matrix3f::Identity();
    if (pose) vehicle_from_level = levelFromVehicle(*pose).transpose().cast<float>();
    std::vector<mavlink::ObstacleDistance3d> messages;
    for (const Obstacle& obstacle : obstacles) {
        const Eigen::Vector3f at_m = vehicle_from_level * obstacle.at_m;
        mavlink::ObstacleDistance3d message;
        message.time_boot_ms = milliseconds(time_s);
        message.x = at_m.x();
        message.y = -at_m.y();
        message.z = -at_m.z();
        message.min_distance = limits.nearest_m;
        message.max_distance = limits.zone_m;
        message.obstacle_id = obstacle.number;
        message.sensor_type = mavlink::kDistanceSensorLaser;
        message.frame = mavlink::kFrameBodyFrd;
        messages.push_back(message);
    }
    return messages;
}

mavlink::DistanceSensor distanceBelow(float distance_m, const Limits& limits, double time_s) {
    mavlink::DistanceSensor message;
    message.time_boot_ms = milliseconds(time_s);
    message.min_distance = centimetres(limits.nearest_m, 1, kMax_cm);
    message.max_distance = centimetres(kGroundReach_m, 1, kMax_cm);
    message.current_distance = centimetres(distance_m, 1, 100 * kGroundReach_m + 1);
    message.type = mavlink::kDistanceSensorLaser;
    message.orientation = mavlink::kRotationPitch270;
    message.covariance = kUnknownVariance;
    return message;
}

mavlink::Heartbeat heartbeat(std::uint8_t state) {
    mavlink::Heartbeat message;
    message.type = mavlink::kTypeOnboardController;
    message.autopilot = mavlink::kAutopilotInvalid;
    message.system_status = state;
    message.mavlink_version = kMavlinkVersion;
    return message;
}

}  // namespace hagen::live
