#pragma once
#include <hagen/scan/Label.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// A segmented scan in the map (a registered scan), or some sectors of one: each return is placed
/// with the estimated pose at its own time. Returns without a valid range are dropped.
struct MappedScan {
    double time_s = 0;                      ///< when the sensor had turned so far
    Eigen::Vector3f origin_m{0, 0, 0};      ///< the sensor, halfway
    std::vector<Eigen::Vector3f> points_m;  ///< all returns within the sensor's range limits
    std::vector<Label> labels;              ///< one entry per point: Rou or Roi
    /// The filter's number of each point's obstacle, 0: none. Empty: not known.
    std::vector<std::int32_t> obstacles;
    std::vector<float> age_s;  ///< from each return to `time_s`. Empty: not known.
    double turns = 1;          ///< how far the sensor turned meanwhile; 1: a whole revolution
    /// Ends of more rays, along which there was nothing: grids clear them, other maps ignore them.
    std::vector<Eigen::Vector3f> passed_to_m{};
};

}  // namespace hagen::observations
