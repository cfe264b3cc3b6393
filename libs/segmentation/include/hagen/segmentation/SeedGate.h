#pragma once
#include <hagen/range_image/Image.h>
#include <vector>

namespace hagen {

/// Keeps, of the seeds of the labelling, those that can be ground: their angle is below `gate_rad`,
/// and there is a pixel with a value above, of which the next is farther away. The lowest return of
/// a column is otherwise an obstacle that stands nearer than the first ring on the ground (a wall,
/// a trunk, the airframe), and would carry its whole face into the ROU.
///
/// `seeds` are pixel indices (column * rows + row) of valid pixels; `pixel_angle_rad` may be NaN
/// there, and then the seed goes. Order is kept.
void gateSeeds(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float gate_rad,
               std::vector<int>& seeds);

}  // namespace hagen
