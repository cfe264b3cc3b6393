#pragma once
#include <hagen/scan/Scan.h>
#include <Eigen/Geometry>
#include <cstddef>

namespace hagen {

/// Moves the returns from index `first` on. Returns whose coordinates overflow have no range.
void moveReturns(const Eigen::Isometry3d& motion, std::size_t first, Scan& scan);

}  // namespace hagen
