#include "filter/image/DeadBeams.h"
#include <algorithm>
#include <cstddef>

namespace hagen {
namespace {

constexpr Eigen::Index kMaxRows = 2;  // max. number of adjacent rows to bridge

/// Checks columns until all rows are found live; the first columns usually suffice.
void findLiveRows(const Image<float>& depth_m, std::vector<std::uint8_t>& is_live) {
    constexpr Eigen::Index kTogether = 32;  // columns per check
    const auto rows = static_cast<std::size_t>(depth_m.rows());
    is_live.assign(rows, 0);
    std::uint8_t* const live = is_live.data();
    for (Eigen::Index column = 0; column < depth_m.cols(); ++column) {
        const float* const depth = depth_m.data() + column * depth_m.rows();
        for (std::size_t row = 0; row < rows; ++row) live[row] |= depth[row] == depth[row];
        if (column % kTogether == 0 &&
            std::all_of(live, live + rows, [](auto l) { return l != 0; }))
            return;
    }
}

/// Sine of the angle from the beam of row `a` up to that of row `b`.
float sineBetween(const PixelDirections& directions, Eigen::Index a, Eigen::Index b) {
    return directions.row_sine[b] * directions.row_cosine[a] -
           directions.row_cosine[b] * directions.row_sine[a];
}

/// Fills the row from the rows below and above; pixels with an empty neighbour stay empty.
void bridgeRow(const PixelDirections& directions, Eigen::Index below, Eigen::Index row,
               Eigen::Index above, Image<float>& repaired_m) {
    const float whole = sineBetween(directions, below, above);
    const float from_below = sineBetween(directions, below, row);
    const float to_above = sineBetween(directions, row, above);
    for (Eigen::Index column = 0; column < repaired_m.cols(); ++column) {
        const float low_m = repaired_m(below, column), high_m = repaired_m(above, column);
        // The point where the beam crosses the line through both points, in polar coordinates.
        repaired_m(row, column) = low_m * high_m * whole / (low_m * from_below + high_m * to_above);
    }
}

}  // namespace

void bridgeDeadBeams(const Image<float>& depth_m, const PixelDirections& directions,
                     Image<float>& repaired_m, DeadBeamsWorkspace& work) {
    findLiveRows(depth_m, work.is_live);
    const Eigen::Index rows = depth_m.rows();
    Eigen::Index below = -1;  // the last live row
    for (Eigen::Index above = 0; above < rows; ++above) {
        if (!work.is_live[above]) continue;
        if (below >= 0 && above - below - 1 <= kMaxRows) {
            for (Eigen::Index row = below + 1; row < above; ++row)
                bridgeRow(directions, below, row, above, repaired_m);
        }
        below = above;
    }
}

}  // namespace hagen
