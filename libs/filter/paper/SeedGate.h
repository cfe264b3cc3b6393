#pragma once
#include <hagen/scan/Image.h>
#include <vector>

namespace hagen {

/// Keeps the seeds that may be ground: their angle is below `gate_rad`, and the next pixel above
/// with a value is farther away. The lowest return of a column may also be an obstacle nearer than
/// the first ring on the ground (a wall, trunk or the airframe) whose whole face would become ROU.
///
/// `seeds` are pixel indices (column * rows + row) of valid pixels. Seeds whose `pixel_angle_rad`
/// is NaN are dropped. Keeps their order.
void gateSeeds(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float gate_rad,
               std::vector<int>& seeds);

}  // namespace hagen
