#pragma once
#include <hagen/observations/VelodyneEncoder.h>

#include "support/SimpleScene.h"

namespace hagen::test {

/// What a level Velodyne at `position_m` measures in a full turn; `range_limit_m` and beyond:
/// nothing.
Firings fireAt(const SimpleScene& scene, const VelodyneModel& model,
               const Eigen::Vector3d& position_m, double range_limit_m = 100.0);

/// A VLP-16 scan from (x_m, 0, 2) of a pole at (12, 2) on flat ground, x_m seconds past a fixed
/// time.
mrpt::obs::CObservationVelodyneScan::Ptr poleScanFrom(double x_m, const std::string& label);

}  // namespace hagen::test
