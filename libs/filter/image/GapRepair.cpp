#include "filter/image/GapRepair.h"
#include <cmath>

namespace hagen {

// Columns are contiguous, so all pixels are computed as one array without branching on empty
// pixels. Pixels at the ends of columns, which would mix two columns, are restored afterwards.
void repairGaps(const Image<float>& depth_m, float max_step_m, Image<float>& repaired_m) {
    const Eigen::Index rows = depth_m.rows(), pixels = depth_m.size();
    if (!(max_step_m > 0)) {
        repaired_m = depth_m;
        return;
    }
    repaired_m.resize(rows, depth_m.cols());
    const float* const depth = depth_m.data();
    float* const repaired = repaired_m.data();
    for (Eigen::Index pixel = 1; pixel + 1 < pixels; ++pixel) {
        const float own = depth[pixel], below = depth[pixel - 1], above = depth[pixel + 1];
        const float mean = 0.5f * (below + above);
        const float filled = std::abs(above - below) < max_step_m ? mean : own;
        repaired[pixel] = own == own ? own : filled;
    }
    for (Eigen::Index first = 0; first < pixels; first += rows) {
        repaired[first] = depth[first];
        repaired[first + rows - 1] = depth[first + rows - 1];
    }
}

}  // namespace hagen
