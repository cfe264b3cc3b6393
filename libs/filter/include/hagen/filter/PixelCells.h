#pragma once
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <cstdint>

namespace hagen {

/// Each pixel's position on the ground grid: the cell of GroundSurface, with a border of one cell
/// on all sides for points outside; and the block of 4 x 4 cells, without a border.
struct PixelCells {
    static constexpr std::uint16_t kNoBlock = 32 * 32;  ///< the pixel is beyond the grid, or empty

    /// An index into a grid with a border, column by column; 0 if the pixel is empty.
    Image<std::uint16_t> cell;
    Image<std::uint16_t> block;  ///< block index, column by column, or kNoBlock
};

/// `pixels` must be in the ground frame.
void findPixelCells(const PixelPoints& pixels, PixelCells& cells);

}  // namespace hagen
