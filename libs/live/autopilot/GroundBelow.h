#pragma once
#include <hagen/filter/Ground.h>
#include <Eigen/Core>
#include <optional>

namespace hagen::live {

/// Distance from the sensor to the ground surface along the vehicle's downward axis, as a
/// rangefinder would measure it. Below the vehicle, where there may be no beams, the filter's
/// ground surface is extrapolated. Returns nullopt if fewer than 20 pixels within 20 m look like
/// ground, or if the vehicle is tilted by more than 60 degrees relative to the ground.
std::optional<float> groundBelow(const Ground& ground, const Eigen::Matrix3f& vehicle_from_sensor);

}  // namespace hagen::live
