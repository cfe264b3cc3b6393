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
    std::uint16_t number = 0;  ///< the same as long as it is followed; never 65535
    Eigen::Vector3f at_m = Eigen::Vector3f::Zero();  ///< in the vehicle's level frame
};

/// Numbers the nearest obstacles, so that they can be followed. An obstacle is what neighbouring
/// directions see less than a metre apart. It keeps its number while its nearest point stays within
/// 1.5 m of where it was, moved by the vehicle's motion, from call to call.
class ObstacleNumbers {
 public:
    /// The nearest ones, at most `most`, nearest first.
    std::vector<Obstacle> nearest(const Directions& directions, std::size_t most,
                                  const std::optional<VehiclePose>& pose);

 private:
    std::vector<Obstacle> last_;
    std::optional<VehiclePose> last_pose_;
    std::uint16_t next_ = 0;
};

}  // namespace hagen::live
