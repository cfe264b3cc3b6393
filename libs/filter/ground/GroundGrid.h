// The grid of the ground surface and of the objects above it.
#pragma once
#include <hagen/filter/GroundSurface.h>
#include <cstddef>
#include <limits>

namespace hagen {

/// The height of an empty cell.
constexpr float kNoHeight = std::numeric_limits<float>::infinity();

/// The grid has a border of one cell on all sides, so that every cell has eight neighbours. Cells
/// are stored column by column.
template <int kSide>
constexpr int kStride = kSide + 2;
constexpr int kGridStride = kStride<GroundSurface::kCells>;
constexpr int kGridSize = kGridStride * kGridStride;

/// The logarithm of the number of cells per side, which is a power of 2.
template <int kSide>
inline constexpr int kLog2 = kLog2<kSide / 2> + 1;
template <>
inline constexpr int kLog2<1> = 0;

/// The index of cell (0, j). Columns -1 and kSide are the border.
template <int kSide = GroundSurface::kCells>
constexpr int gridColumn(int j) {
    return (j + 1) * kStride<kSide> + 1;
}

/// Calls visit(k) for each k below `size`. Interleaves four ranges, because adjacent pixels often
/// share a cell, and consecutive updates of the same cell would stall.
template <class Visit>
__attribute__((always_inline)) inline void visitByTurns(std::size_t size, Visit visit) {
    const std::size_t quarter = size / 4;
    for (std::size_t k = 0; k < quarter; ++k) {
        visit(k);
        visit(k + quarter);
        visit(k + 2 * quarter);
        visit(k + 3 * quarter);
    }
    for (std::size_t k = 4 * quarter; k < size; ++k) visit(k);
}

}  // namespace hagen
