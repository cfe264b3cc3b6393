#pragma once
#include <hagen/observations/VelodyneEncoder.h>

#include "support/SimpleScene.h"

namespace hagen::test {

/// What a level Velodyne at `position_m` measures in a full turn; `range_limit_m` and beyond:
/// nothing.
Firings fireAt(const SimpleScene& scene, const VelodyneModel& model,
               const Eigen::Vector3d& position_m, double range_limit_m = 100.0);

}  // namespace hagen::test
