#pragma once
#include <hagen/observations/VelodyneEncoder.h>

#include "support/SimpleScene.h"

namespace hagen::test {

/// What a level Velodyne measures in a full turn of 0.1 s, from `position_m` at its start, moving
/// on at `velocity_m_s`; `range_limit_m` and beyond: nothing.
observations::Firings fireAt(const SimpleScene& scene, const observations::VelodyneModel& model,
                             const Eigen::Vector3d& position_m,
                             const Eigen::Vector3d& velocity_m_s = Eigen::Vector3d::Zero(),
                             double range_limit_m = 100.0);

/// A VLP-16 scan from (x_m, 0, 2) of a pole at (12, 2) on flat ground, x_m seconds past a fixed
/// time.
mrpt::obs::CObservationVelodyneScan::Ptr poleScanFrom(double x_m, const std::string& label);

}  // namespace hagen::test
