#pragma once
// Sensors, options and numbers of which a filter may be made.
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Geometry>

#include <optional>

#include "fuzz/Target.h"

namespace hagen::fuzz {

/// A number that is often an odd one.
float oddNumber(Parts& parts);

/// Changes some options, within their limits. Images get up to 256 columns.
void setOptions(Parts& parts, Options& options);

/// Throws std::invalid_argument: too few beams.
SensorModel anySensor(Parts& parts);

/// None, or any numbers.
std::optional<Attitude> anyTilt(Parts& parts);
std::optional<Eigen::Isometry3d> anyPose(Parts& parts);

}  // namespace hagen::fuzz
