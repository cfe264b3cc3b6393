#pragma once
#include <hagen/filter/Ground.h>
#include <Eigen/Core>
#include <optional>

namespace hagen::live {

/// How far the ground's surface is from the sensor along the vehicle's own downward axis, as a
/// rangefinder would measure it. A sensor that has no beam there sees the ground around: the
/// surface is that which the filter continues below the vehicle. None: fewer than 20 pixels
/// within 20 m look like ground, or the vehicle is tilted against it by more than 60 degrees.
std::optional<float> groundBelow(const Ground& ground, const Eigen::Matrix3f& vehicle_from_sensor);

}  // namespace hagen::live
