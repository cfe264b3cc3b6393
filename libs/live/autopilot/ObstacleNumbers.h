#pragma once
#include <Eigen/Core>
#include "live/Directions.h"
#include "live/autopilot/VehicleMotion.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::live {

/// The nearest point of an obstacle.
struct Obstacle {
    std::uint16_t number = 0;  ///< constant while the obstacle is tracked; not 65535
    Eigen::Vector3f at_m = Eigen::Vector3f::Zero();  ///< in the vehicle's level frame
};

/// Tracks and numbers the nearest obstacles. Neighbouring directions whose points are less than 1 m
/// apart form one obstacle. An obstacle keeps its number while its nearest point, corrected for the
/// vehicle's motion, moves at most 1.5 m between calls.
class ObstacleNumbers {
 public:
    /// Returns up to `max` obstacles, nearest first.
    std::vector<Obstacle> nearest(const Directions& directions, std::size_t max,
                                  const std::optional<VehiclePose>& pose);

 private:
    std::vector<Obstacle> last_;
    std::optional<VehiclePose> last_pose_;
    std::uint16_t next_ = 0;
};

}  // namespace hagen::live
