#include <algorithm>
#include <cmath>
#include <vector>

#include "filter/ground/BlockSums.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {
namespace {

using namespace canopy_rules;

/// Statistics of the cells with returns around a block.
struct Surroundings {
    int seen = 0;                  ///< number of cells
    int tall = 0;                  ///< cells whose highest return is above plants
    int plants = 0;                ///< cells whose highest return is a low plant
    double sum_m = 0, sum_m2 = 0;  ///< sums of plant heights and of their squares

    void addCell(float top_m, float tallest_m) {
        if (top_m == CellTops::kNone_m) return;
        seen += 1;
        tall += top_m >= tallest_m;
        if (!(top_m > kMinHeight_m && top_m < tallest_m)) return;
        plants += 1;
        sum_m += top_m;
        sum_m2 += static_cast<double>(top_m) * top_m;
    }
    /// The height of the canopy; 0 if there is none.
    float canopy_m() const {
        const auto all = static_cast<float>(seen);
        const bool is_canopy = all >= kMinCells && static_cast<float>(plants) >= kMinShare * all &&
                               static_cast<float>(tall) <= kMaxTall * all;
        return is_canopy ? canopyHeight_m(plants, sum_m, sum_m2) : 0.0f;
    }
};

Surroundings surroundingsOf(int block, const CellTops& tops, float tallest_m) {
    // The range of cells along one axis of the square around the block; the grid has a border of
    // one cell.
    const auto first = [](int b) { return std::max(b - kReach, 0) * kBlockCells + 1; };
    const auto end = [](int b) { return std::min(b + kReach + 1, kBlocks) * kBlockCells + 1; };
    const int row = block % kBlocks, column = block / kBlocks;
    Surroundings around;
    for (int j = first(column); j < end(column); ++j) {
        for (int i = first(row); i < end(row); ++i) {
            around.addCell(tops.highest_m(i, j), tallest_m);
        }
    }
    return around;
}

}  // namespace

void tolerateCanopy(const PixelCells& cells, const CellTops& tops, float sensor_height_m,
                    Image<float>& tolerance_m) {
    std::vector<float> canopy_m(kBlocks * kBlocks + 1, 0.0f);  // last element: beyond the grid
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        canopy_m[block] =
            surroundingsOf(block, tops, std::min(kTallest_m, kTallestSeen * sensor_height_m))
                .canopy_m();
    }
    for (Eigen::Index pixel = 0; pixel < tolerance_m.size(); ++pixel) {
        float& tolerated_m = tolerance_m.data()[pixel];
        const float of_block_m = canopy_m[cells.block.data()[pixel]];
        const bool stands_out =
            tops.top_m.data()[cells.cell.data()[pixel]] > of_block_m + kStandsOut_m;
        if (!stands_out && of_block_m > tolerated_m) tolerated_m = of_block_m;
    }
}

}  // namespace hagen::plain
