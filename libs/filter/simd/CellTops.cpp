#include <hagen/filter/CellTops.h>
#include <algorithm>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/CellTops.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// Raises the two highest points of each cell.
void RaiseTopsIn(std::size_t pixels, const float* HWY_RESTRICT height_m,
                 const std::uint16_t* HWY_RESTRICT cell, float* two_m) {
    visitChosen(
        pixels,
        [&](auto d, std::size_t pixel, auto& heights_m, auto& cells) HAGEN_INLINE {
            const hn::Rebind<std::uint16_t, decltype(d)> d16;
            heights_m = hn::LoadU(d, height_m + pixel);
            cells = hn::PromoteTo(hn::RebindToSigned<decltype(d)>(), hn::LoadU(d16, cell + pixel));
            return hn::Lt(heights_m, hn::Set(d, tops_rules::kOverhead_m));  // false for NaN
        },
        [&](float own_m, std::int32_t of_cell) HAGEN_INLINE {
            const std::ptrdiff_t first = 2 * of_cell, second = first + 1;
            two_m[second] = std::max(two_m[second], std::min(own_m, two_m[first]));
            two_m[first] = std::max(two_m[first], own_m);
        });
}

/// The highest point of each cell, and the second highest (the highest if it is the only one), for
/// consecutive `cells`.
void SeparateIn(const float* HWY_RESTRICT two_m, std::size_t cells, float* HWY_RESTRICT highest_m,
                float* HWY_RESTRICT top_m) {
    forEachVector(cells, [&](auto d, std::size_t k) HAGEN_INLINE {
        const auto none_m = hn::Set(d, CellTops::kNone_m);
        auto first_m = none_m, second_m = none_m;
        hn::LoadInterleaved2(d, two_m + 2 * k, first_m, second_m);
        hn::StoreU(first_m, d, highest_m + k);
        hn::StoreU(hn::IfThenElse(hn::Eq(second_m, none_m), first_m, second_m), d, top_m + k);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(RaiseTopsIn);
HWY_EXPORT(SeparateIn);

/// Calls visit(first, cells) for each contiguous range of cells.
template <class Visit>
void forEachStretch(const CellArea& area, Visit visit) {
    const int rows = area.end_row - area.first_row;
    if (rows == kGridStride) {
        return visit(area.first_column * kGridStride,
                     (area.end_column - area.first_column) * kGridStride);
    }
    for (int column = area.first_column; column < area.end_column; ++column) {
        visit(column * kGridStride + area.first_row, rows);
    }
}

}  // namespace

void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops,
                  const CellArea& area) {
    tops.area = area;
    tops.two_m.resize(2 * kGridSize);
    float* const two_m = tops.two_m.data();
    forEachStretch(area, [=](int first, int size) {
        std::fill_n(two_m + 2 * first, 2 * size, CellTops::kNone_m);
    });
    HWY_DYNAMIC_DISPATCH(RaiseTopsIn)
    (static_cast<std::size_t>(height_m.size()), height_m.data(), cells.cell.data(), two_m);

    for (auto* grid : {&tops.highest_m, &tops.top_m}) {
        if (grid->size() == 0) grid->setConstant(kGridStride, kGridStride, CellTops::kNone_m);
    }
    forEachStretch(area, [&](int first, int size) {
        HWY_DYNAMIC_DISPATCH(SeparateIn)
        (two_m + 2 * first, size, tops.highest_m.data() + first, tops.top_m.data() + first);
    });
}

}  // namespace hagen
#endif
