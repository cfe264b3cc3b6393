#include <hagen/filter/CellTops.h>
#include <hwy/highway.h>
#include <algorithm>
#include "scan/InstructionSets.h"

#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"

namespace hagen {
namespace {

using tops_rules::kOverhead_m;
constexpr int kTogether = 4;  // cells

/// The highest point of each cell, and the second highest (the highest if it is the only one), for
/// consecutive `cells`. HWY_ATTR: GCC for ARM rejects Highway's functions without it.
HWY_ATTR void separate(const float* two_m, int cells, float* highest_m, float* top_m) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<float, 4> d;  // uses the instruction set of the rest of this file
    const auto none_m = hn::Set(d, CellTops::kNone_m);
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
    static_assert(kTogether % kLanes == 0);
    for (int k = 0; k < cells; k += kLanes) {
        auto first_m = none_m, second_m = none_m;
        hn::LoadInterleaved2(d, two_m + 2 * k, first_m, second_m);
        hn::StoreU(first_m, d, highest_m + k);
        hn::StoreU(hn::IfThenElse(hn::Eq(second_m, none_m), first_m, second_m), d, top_m + k);
    }
}

/// Calls visit(first, cells) for each contiguous range of cells. Rounds up to a multiple of
/// kTogether; the next column overwrites up to three surplus cells.
template <class Visit>
void forEachStretch(const CellArea& area, Visit visit) {
    static_assert(kGridSize % kTogether == 0);
    if (area.first_row == 0 && area.end_row == kGridStride) {
        return visit(area.first_column * kGridStride,
                     (area.end_column - area.first_column) * kGridStride);
    }
    const int rows = (area.end_row - area.first_row + kTogether - 1) / kTogether * kTogether;
    for (int column = area.first_column; column < area.end_column; ++column) {
        const int first = column * kGridStride + area.first_row;
        visit(first, std::min(rows, kGridSize - first));
    }
}

}  // namespace

void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops,
                  const CellArea& area) {
    tops.area = area;
    tops.two_m.resize(2 * kGridSize);
    float* const two_m = tops.two_m.data();
    const float* const h_m = height_m.data();
    const std::uint16_t* const cell = cells.cell.data();
    const float none_m = CellTops::kNone_m;
    forEachStretch(area, [=](int first, int size) {
        std::fill_n(two_m + 2 * first, 2 * size, CellTops::kNone_m);
    });
    const auto raise = [=](std::size_t pixel) __attribute__((always_inline)) {
        float &first_m = two_m[2 * cell[pixel]], &second_m = two_m[2 * cell[pixel] + 1];
        const float own_m = h_m[pixel] < kOverhead_m ? h_m[pixel] : none_m;  // none if NaN
        second_m = std::max(second_m, std::min(own_m, first_m));
        first_m = std::max(first_m, own_m);
    };
    visitByTurns(static_cast<std::size_t>(height_m.size()), raise);

    for (auto* grid : {&tops.highest_m, &tops.top_m}) {
        if (grid->size() == 0) grid->setConstant(kGridStride, kGridStride, CellTops::kNone_m);
    }
    forEachStretch(area, [&](int first, int size) {
        separate(two_m + 2 * first, size, tops.highest_m.data() + first, tops.top_m.data() + first);
    });
}

}  // namespace hagen
