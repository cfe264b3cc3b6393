#pragma once
#include "live/Directions.h"
#include "live/autopilot/Messages.h"
#include "live/autopilot/ObstacleNumbers.h"
#include "live/autopilot/VehicleMotion.h"

#include <optional>
#include <vector>

namespace hagen::live {

/// Sensor limits reported in the messages.
struct Limits {
    float zone_m = 20;       ///< farther obstacles are ignored
    float nearest_m = 0.5f;  ///< minimum range of the sensor
};

/// OBSTACLE_DISTANCE: 72 directions of 5 degrees, the first centred straight ahead. Distances are
/// horizontal, from 1 cm to the zone; zone + 1 cm means no obstacle, 65535 unknown.
mavlink::ObstacleDistance obstacleDistance(const Directions& directions, const Limits& limits,
                                           double time_s);

/// One OBSTACLE_DISTANCE_3D per obstacle, in the body frame, which tilts with the vehicle. All
/// messages have the same time.
std::vector<mavlink::ObstacleDistance3d> obstacleDistances3d(const std::vector<Obstacle>& obstacles,
                                                             const std::optional<VehiclePose>& pose,
                                                             const Limits& limits, double time_s);

/// Downward DISTANCE_SENSOR from groundBelow(). Distances beyond 40 m are sent as 40.01 m, which is
/// above the stated maximum.
mavlink::DistanceSensor distanceBelow(float distance_m, const Limits& limits, double time_s);

/// HEARTBEAT of an onboard computer; `state` is one of mavlink::kState...
mavlink::Heartbeat heartbeat(std::uint8_t state);

}  // namespace hagen::live
