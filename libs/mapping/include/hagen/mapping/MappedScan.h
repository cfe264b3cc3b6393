#pragma once
#include <hagen/range_image/Label.h>
#include <Eigen/Core>
#include <vector>

namespace hagen::mapping {

/// A segmented scan in the map: each return at the pose that the vehicle believed to have when it
/// was taken. Returns without a valid range are not in it.
struct MappedScan {
    double time_s = 0;                      ///< when the turn was complete
    Eigen::Vector3f origin_m{0, 0, 0};      ///< the sensor, in the middle of the turn
    std::vector<Eigen::Vector3f> points_m;  ///< all returns, out to the sensor's own range
    std::vector<Label> labels;              ///< an entry a point: Rou or Roi
};

}  // namespace hagen::mapping
