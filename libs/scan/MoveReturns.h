#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Geometry>
#include <cstddef>

namespace hagen {

/// Moves the returns from index `first` on. Returns whose coordinates overflow have no range.
void moveReturns(const Eigen::Isometry3d& motion, std::size_t first, Scan& scan);

/// locateBeams() for moved returns. Returns outside the field of view, which no row fits, get no
/// range.
void locateInView(const SensorModel& sensor, Scan& scan);

}  // namespace hagen
