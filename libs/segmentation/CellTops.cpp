#include <hagen/segmentation/CellTops.h>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "CellTops.cpp"
#include <hwy/foreach_target.h>
#include "GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

void FindCellsIn(std::size_t pixels, const float* HWY_RESTRICT x_m, const float* HWY_RESTRICT y_m,
                 std::int32_t* HWY_RESTRICT cell) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto cells = gridCells(d, hn::LoadU(d, x_m + pixel), hn::LoadU(d, y_m + pixel));
        hn::StoreU(cells.cell, di, cell + pixel);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {

HWY_EXPORT(FindCellsIn);

static constexpr float kOverhead_m = 1.5f;  // what is higher need not stand in its cell

void findCellTops(const PixelPoints& pixels, const Image<float>& height_m, CellTops& tops) {
    tops.cell.resize(height_m.rows(), height_m.cols());
    HWY_DYNAMIC_DISPATCH(FindCellsIn)
    (tops.cell.size(), pixels.x_m.data(), pixels.y_m.data(), tops.cell.data());

    tops.highest_m.setConstant(kGridStride, kGridStride, CellTops::kNone_m);
    tops.top_m.setConstant(kGridStride, kGridStride, CellTops::kNone_m);
    float *const highest_m = tops.highest_m.data(), *const top_m = tops.top_m.data();
    const float* const h_m = height_m.data();
    const std::int32_t* const cell = tops.cell.data();
    const auto raise = [=](std::size_t pixel) __attribute__((always_inline)) {
        float &first_m = highest_m[cell[pixel]], &second_m = top_m[cell[pixel]];
        float own_m = CellTops::kNone_m;
        own_m = h_m[pixel] < kOverhead_m ? h_m[pixel] : own_m;  // NaN: none
        const float lower_m = own_m < first_m ? own_m : first_m;
        second_m = lower_m > second_m ? lower_m : second_m;
        first_m = own_m > first_m ? own_m : first_m;
    };
    visitByTurns(static_cast<std::size_t>(height_m.size()), raise);
    for (Eigen::Index k = 0; k < tops.top_m.size(); ++k)
        top_m[k] = top_m[k] == CellTops::kNone_m ? highest_m[k] : top_m[k];  // the only one
}

}  // namespace hagen
#endif
