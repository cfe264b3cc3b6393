#include <hagen/filter/PixelCells.h>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/PixelCells.cpp"
#include <hwy/foreach_target.h>
#include "filter/ground/BlockSums.h"
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

void FindPixelCellsIn(std::size_t pixels, const float* HWY_RESTRICT x_m,
                      const float* HWY_RESTRICT y_m, std::uint16_t* HWY_RESTRICT cell,
                      std::uint16_t* HWY_RESTRICT block) {
    static_assert(kBlockCells == 1 << 2 && kBlocks == 1 << 5);
    static_assert(PixelCells::kNoBlock == kBlocks * kBlocks);
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint16_t, decltype(d)> d16;
        const auto at = gridCells(d, hn::LoadU(d, x_m + pixel), hn::LoadU(d, y_m + pixel));
        hn::StoreU(hn::DemoteTo(d16, at.cell), d16, cell + pixel);
        const auto blocksFrom = [&](auto cells) HAGEN_INLINE {
            return hn::ShiftRight<2>(hn::Sub(cells, hn::Set(di, 1)));
        };
        const auto own = hn::Add(hn::ShiftLeft<5>(blocksFrom(at.j)), blocksFrom(at.i));
        const auto is_on_grid = hn::RebindMask(di, at.is_on_grid);
        hn::StoreU(
            hn::DemoteTo(d16, hn::IfThenElse(is_on_grid, own, hn::Set(di, PixelCells::kNoBlock))),
            d16, block + pixel);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {

HWY_EXPORT(FindPixelCellsIn);

void findPixelCells(const PixelPoints& pixels, PixelCells& cells) {
    for (auto* image : {&cells.cell, &cells.block}) {
        image->resize(pixels.x_m.rows(), pixels.x_m.cols());
    }
    HWY_DYNAMIC_DISPATCH(FindPixelCellsIn)
    (static_cast<std::size_t>(pixels.x_m.size()), pixels.x_m.data(), pixels.y_m.data(),
     cells.cell.data(), cells.block.data());
}

}  // namespace hagen
#endif
