#include <hagen/segmentation/CellTops.h>
#include <hwy/highway.h>
#include <algorithm>

#include "GroundGrid.h"

namespace hagen {
namespace {

constexpr float kOverhead_m = 1.5f;  // what is higher need not stand in its cell

/// The highest of each cell, and its second highest, or the highest if it is the only one.
/// HWY_ATTR: GCC for ARM refuses Highway's functions without it.
HWY_ATTR void separate(const float* two_m, float* highest_m, float* top_m) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<float, 4> d;  // has no better instruction set than the rest of this file
    const auto none_m = hn::Set(d, CellTops::kNone_m);
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
    static_assert(kGridSize % kLanes == 0);
    for (int k = 0; k < kGridSize; k += kLanes) {
        auto first_m = none_m, second_m = none_m;
        hn::LoadInterleaved2(d, two_m + 2 * k, first_m, second_m);
        hn::StoreU(first_m, d, highest_m + k);
        hn::StoreU(hn::IfThenElse(hn::Eq(second_m, none_m), first_m, second_m), d, top_m + k);
    }
}

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
    separate(two_m, tops.highest_m.data(), tops.top_m.data());
}

}  // namespace hagen
