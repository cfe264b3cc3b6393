#pragma once
#include <hagen/filter/GroundSurface.h>
#include <algorithm>

namespace hagen {

/// A rectangle of the ground grid and its border, from `first` to `end` (exclusive). Stages compute
/// only cells of this area and leave all others unchanged.
struct CellArea {
    static constexpr int kSide = GroundSurface::kCells + 2;
    int first_row = 0, end_row = kSide, first_column = 0, end_column = kSide;

    /// The area expanded by `cells` on all sides, clipped to the grid.
    CellArea grownBy(int cells) const {
        return {std::max(first_row - cells, 0), std::min(end_row + cells, kSide),
                std::max(first_column - cells, 0), std::min(end_column + cells, kSide)};
    }
};

}  // namespace hagen
