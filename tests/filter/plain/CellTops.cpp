#include <algorithm>

#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {

void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops) {
    tops.two_m.assign(2 * kGridSize, CellTops::kNone_m);
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        float h_m = height_m.data()[pixel];
        if (!(h_m < tops_rules::kOverhead_m)) continue;  // skips NaN (empty) too
        float* const two_m = &tops.two_m[2 * std::size_t{cells.cell.data()[pixel]}];
        if (h_m > two_m[0]) std::swap(h_m, two_m[0]);
        two_m[1] = std::max(h_m, two_m[1]);
    }
    tops.highest_m.resize(kGridStride, kGridStride);
    tops.top_m.resize(kGridStride, kGridStride);
    for (Eigen::Index cell = 0; cell < kGridSize; ++cell) {
        const float first_m = tops.two_m[2 * cell], second_m = tops.two_m[2 * cell + 1];
        tops.highest_m.data()[cell] = first_m;
        tops.top_m.data()[cell] = second_m == CellTops::kNone_m ? first_m : second_m;
    }
}

}  // namespace hagen::plain
