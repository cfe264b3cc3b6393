#pragma once
#include <hagen/scan/Label.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// A segmented scan, or some of its sectors, registered in the map: each return is placed with the
/// estimated pose at its own time. Returns without a valid range are dropped.
struct MappedScan {
    double time_s = 0;                      ///< time at the end of the sectors
    Eigen::Vector3f origin_m{0, 0, 0};      ///< sensor position halfway through the scan
    std::vector<Eigen::Vector3f> points_m;  ///< all returns within the sensor's range limits
    std::vector<Label> labels;              ///< one entry per point: Rou or Roi
    /// The filter's obstacle number of each point, 0 for no obstacle. Empty if unknown.
    std::vector<std::int32_t> obstacles;
    std::vector<float> age_s;  ///< time from each return to `time_s`; empty if unknown
    double turns = 1;          ///< revolutions of the sensor
    /// Ends of rays without returns. Grids clear these rays, other maps ignore them.
    std::vector<Eigen::Vector3f> passed_to_m{};
};

}  // namespace hagen::observations
