#pragma once
// Random sensors, options and numbers for a filter.
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Geometry>

#include <optional>

#include "fuzz/Target.h"

namespace hagen::fuzz {

/// A number, often an extreme one.
float oddNumber(Parts& parts);

/// Changes some options within their limits. Images have up to 256 columns.
void setOptions(Parts& parts, Options& options);

/// A random sensor. Throws std::invalid_argument if it has too few beams.
SensorModel anySensor(Parts& parts);

/// An attitude of arbitrary numbers, or none.
std::optional<Attitude> anyTilt(Parts& parts);
std::optional<Eigen::Isometry3d> anyPose(Parts& parts);

}  // namespace hagen::fuzz
