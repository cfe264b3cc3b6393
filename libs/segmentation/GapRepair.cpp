#include <hagen/segmentation/GapRepair.h>
#include <cmath>

namespace hagen {

void repairGaps(const Image<float>& depth_m, float max_step_m, Image<float>& repaired_m) {
    repaired_m = depth_m;
    for (int column = 0; column < depth_m.cols(); ++column) {
        for (int row = 1; row + 1 < depth_m.rows(); ++row) {
            if (hasValue(depth_m(row, column))) continue;
            const float below = depth_m(row - 1, column), above = depth_m(row + 1, column);
            if (std::abs(above - below) < max_step_m) {  // false where either is empty
                repaired_m(row, column) = 0.5f * (below + above);
            }
        }
    }
}

}  // namespace hagen
