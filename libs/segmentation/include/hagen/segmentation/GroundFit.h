#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// A square grid of heights, with a border of one cell all around, column by column.
struct HeightGrid {
    int cells = 0;                  ///< along each side, without the border
    std::vector<float> weighted_m;  ///< height times weight
    std::vector<float> weight;      ///< how much the height is trusted, 0 to 1
    std::vector<float> height_m;    ///< of every cell, once those without weight have been filled

    /// The index of cell (0, j).
    int column(int j) const { return (j + 1) * (cells + 2) + 1; }
};

/// The memory to fit a surface on a grid of kSide x kSide cells. Grids have a border of one cell
/// all around; cells are indices into them.
template <int kSide>
struct GroundFit {
    static constexpr int kSize = (kSide + 2) * (kSide + 2);

    // The pixels that can be ground. Lists may be longer.
    std::size_t candidates = 0;
    std::vector<std::int32_t> cell;
    std::vector<float> z_m;

    // Step 1 and 2: the lowest candidate of each cell, without strays and obstacles; infinite where
    // there is none.
    std::vector<float> lowest_m, cleaned_m;
    std::vector<float> ramp_m, envelope_m;  ///< how high the ground may climb

    // Step 3: sums over candidates, then weighted heights and their weights.
    std::vector<float> sum_m, number;

    // Step 4: from the finest grid to a single cell.
    std::vector<HeightGrid> pyramid;
};

}  // namespace hagen
