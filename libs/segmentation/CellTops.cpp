#include <hagen/segmentation/CellTops.h>
#include <algorithm>

#include "GroundGrid.h"

namespace hagen {
namespace {

constexpr float kOverhead_m = 1.5f;  // what is higher need not stand in its cell

}  // namespace

void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops) {
    tops.two_m.assign(2 * kGridSize, CellTops::kNone_m);
    float* const two_m = tops.two_m.data();
    const float* const h_m = height_m.data();
    const std::uint16_t* const cell = cells.cell.data();
    const float none_m = CellTops::kNone_m;
    const auto raise = [=](std::size_t pixel) __attribute__((always_inline)) {
        float &first_m = two_m[2 * cell[pixel]], &second_m = two_m[2 * cell[pixel] + 1];
        const float own_m = h_m[pixel] < kOverhead_m ? h_m[pixel] : none_m;  // NaN: none
        second_m = std::max(second_m, std::min(own_m, first_m));
        first_m = std::max(first_m, own_m);
    };
    visitByTurns(static_cast<std::size_t>(height_m.size()), raise);

    tops.highest_m.resize(kGridStride, kGridStride);
    tops.top_m.resize(kGridStride, kGridStride);
    float *const highest_m = tops.highest_m.data(), *const top_m = tops.top_m.data();
    for (int k = 0; k < kGridSize; ++k) {
        const float first_m = two_m[2 * k], second_m = two_m[2 * k + 1];
        highest_m[k] = first_m;
        top_m[k] = second_m == CellTops::kNone_m ? first_m : second_m;  // the only one
    }
}

}  // namespace hagen
