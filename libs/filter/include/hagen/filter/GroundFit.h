#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// A square grid of heights, with a border of one cell on all sides, column by column.
struct HeightGrid {
    int cells = 0;                  ///< per side, without the border
    std::vector<float> weighted_m;  ///< height times weight
    std::vector<float> weight;      ///< confidence in the height, 0 to 1
    std::vector<float> height_m;    ///< height of every cell; cells without weight are filled

    /// The index of cell (0, j).
    int column(int j) const { return (j + 1) * (cells + 2) + 1; }
};

/// Workspace for fitting a surface on a grid of kSide x kSide cells. Grids have a border of one
/// cell on all sides; cells are indices into them.
template <int kSide>
struct GroundFit {
    static constexpr int kSize = (kSide + 2) * (kSide + 2);

    // The pixels that may be ground. Lists may have unused entries at the end.
    std::size_t candidates = 0;
    std::vector<std::int32_t> cell;
    std::vector<float> z_m;

    // Steps 1 and 2: the lowest candidate of each cell, without outliers and obstacles; infinite
    // without candidates.
    std::vector<float> lowest_m, cleaned_m;
    std::vector<float> ramp_m, envelope_m;  ///< maximum climb of the ground

    // Step 3: sums over candidates, then weighted heights and their weights.
    std::vector<float> sum_m, number;

    // Step 4: from the finest grid to a single cell.
    std::vector<HeightGrid> pyramid;
};

}  // namespace hagen
