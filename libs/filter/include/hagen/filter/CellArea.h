#pragma once
#include <hagen/filter/GroundSurface.h>
#include <algorithm>

namespace hagen {

/// A rectangle of the ground grid and its border, from `first` up to before `end`. A stage that
/// gets one computes these cells and leaves all others as they are.
struct CellArea {
    static constexpr int kSide = GroundSurface::kCells + 2;
    int first_row = 0, end_row = kSide, first_column = 0, end_column = kSide;

    /// With so many cells more on all sides, on the grid.
    CellArea grownBy(int cells) const {
        return {std::max(first_row - cells, 0), std::min(end_row + cells, kSide),
                std::max(first_column - cells, 0), std::min(end_column + cells, kSide)};
    }
};

}  // namespace hagen
