#include "filter/ground/BlockSums.h"
#include "filter/ground/GroundGrid.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {
namespace {

struct Place {
    int index;  ///< 1 is the first cell; 0 and kCells + 1 are the border
    bool is_on_grid;
};

/// The place along one axis. Empty pixels are in cell 0.
Place placeOf(float coordinate_m) {
    constexpr int kMiddle = GroundSurface::kCells / 2 + 1;
    constexpr float kLast = kGridStride - 1;
    const float place = coordinate_m * (1 / GroundSurface::kCell_m) + kMiddle;
    return {static_cast<int>(std::min(place > 0 ? place : 0.0f, kLast)),
            place >= 1 && place < kLast};
}

}  // namespace

void findPixelCells(const PixelPoints& pixels, PixelCells& cells) {
    for (auto* image : {&cells.cell, &cells.block}) {
        image->resize(pixels.x_m.rows(), pixels.x_m.cols());
    }
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        const Place i = placeOf(pixels.x_m.data()[pixel]), j = placeOf(pixels.y_m.data()[pixel]);
        const int block = (j.index - 1) / kBlockCells * kBlocks + (i.index - 1) / kBlockCells;
        const bool is_on_grid = i.is_on_grid && j.is_on_grid;
        cells.cell.data()[pixel] = static_cast<std::uint16_t>(j.index * kGridStride + i.index);
        cells.block.data()[pixel] =
            is_on_grid ? static_cast<std::uint16_t>(block) : PixelCells::kNoBlock;
    }
}

}  // namespace hagen::plain
