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

void findCellTops(const PixelPoints& pixels, const Image<float>& height_m, CellTops& tops) {
    tops.cell.resize(height_m.rows(), height_m.cols());
    HWY_DYNAMIC_DISPATCH(FindCellsIn)
    (tops.cell.size(), pixels.x_m.data(), pixels.y_m.data(), tops.cell.data());

    tops.top_m.setConstant(kGridStride, kGridStride, CellTops::kNone_m);
    float* const top_m = tops.top_m.data();
    const float* const h_m = height_m.data();
    const std::int32_t* const cell = tops.cell.data();
    const auto raise = [=](std::size_t pixel) __attribute__((always_inline)) {
        float& highest_m = top_m[cell[pixel]];
        highest_m = h_m[pixel] > highest_m ? h_m[pixel] : highest_m;  // ignores NaN
    };
    visitByTurns(static_cast<std::size_t>(height_m.size()), raise);
}

}  // namespace hagen
#endif
