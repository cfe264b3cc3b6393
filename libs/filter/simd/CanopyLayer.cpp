#include "filter/simd/CanopyLayer.h"
#include <hagen/filter/GroundSurface.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include "scan/InstructionSets.h"

#include "filter/ground/BlockSums.h"
#include "filter/ground/StageRules.h"

namespace hagen {
namespace {

constexpr int kCells = GroundSurface::kCells;
using namespace canopy_rules;

/// Counts of the cells of one or more blocks.
struct Census {
    int seen = 0;    ///< cells with returns
    int tall = 0;    ///< cells whose highest return is above plants
    int plants = 0;  ///< cells whose highest return is a low plant

    void add(const Census& other) {
        seen += other.seen;
        tall += other.tall;
        plants += other.plants;
    }
    void remove(const Census& other) {
        seen -= other.seen;
        tall -= other.tall;
        plants -= other.plants;
    }
    bool isCanopy() const {
        const auto all = static_cast<float>(seen);
        return all >= kMinCells && static_cast<float>(plants) >= kMinShare * all &&
               static_cast<float>(tall) <= kMaxTall * all;
    }
};

/// Heights of the plants in the cells of one or more blocks. Sums are doubles, to keep the rounding
/// error of subtracted blocks small.
struct Heights {
    double sum_m = 0;   ///< sum of the plants' heights
    double sum_m2 = 0;  ///< sum of their squares

    void add(const Heights& other) {
        sum_m += other.sum_m;
        sum_m2 += other.sum_m2;
    }
    void remove(const Heights& other) {
        sum_m -= other.sum_m;
        sum_m2 -= other.sum_m2;
    }
};

bool isPlant(float top_m, float tallest_m) { return (top_m > kMinHeight_m) & (top_m < tallest_m); }

/// The highest return of each cell in a column of the grid, without the border.
const float* columnOf(const CellTops& tops, int j) { return tops.highest_m.col(j + 1).data() + 1; }

void countCells(const CellTops& tops, float tallest_m, const BlockArea& area,
                Blocks<Census>& blocks) {
    constexpr std::int32_t kTall = 1 << 8, kPlants = 1 << 16;  // packs three counts into one number
    for (int column = area.first_column; column < area.end_column; ++column) {
        std::int32_t counts[kCells] = {};
        const int first = column * kBlockCells;
        for (int j = first; j < first + kBlockCells; ++j) {
            const float* const top_m = columnOf(tops, j);
            for (int i = 0; i < kCells; ++i) {  // so that the compiler vectorises the loop
                counts[i] += (top_m[i] != CellTops::kNone_m ? 1 : 0) +
                             (top_m[i] >= tallest_m ? kTall : 0) +
                             (isPlant(top_m[i], tallest_m) ? kPlants : 0);
            }
        }
        for (int block = area.first_row; block < area.end_row; ++block) {
            std::int32_t sum = 0;
            for (int k = 0; k < kBlockCells; ++k) sum += counts[block * kBlockCells + k];
            blocks[column * kBlocks + block] = {sum % kTall, sum / kTall % kTall, sum / kPlants};
        }
    }
}

/// `own` contains the sums of each block. Most blocks have no plants.
void sumHeights(const CellTops& tops, float tallest_m, const Blocks<Census>& own,
                Blocks<Heights>& blocks) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        blocks[block] = {};
        if (own[block].plants == 0) continue;
        for (int j = 0; j < kBlockCells; ++j) {
            const float* const column_m = columnOf(tops, block / kBlocks * kBlockCells + j);
            for (int i = 0; i < kBlockCells; ++i) {
                const float top_m = column_m[block % kBlocks * kBlockCells + i];
                if (!isPlant(top_m, tallest_m)) continue;
                blocks[block].add({top_m, static_cast<double>(top_m) * top_m});
            }
        }
    }
}

/// Raises the tolerance of each pixel to the canopy of its block, unless an object in its cell
/// protrudes from it; NaN stays NaN.
void raiseTolerances(const PixelCells& cells, const CellTops& tops,
                     const BlocksAndNone<float>& canopy_m, Image<float>& tolerance_m) {
    for (Eigen::Index pixel = 0; pixel < tolerance_m.size(); ++pixel) {
        float& tolerated_m = tolerance_m.data()[pixel];
        const float of_block_m = canopy_m[cells.block.data()[pixel]];
        const float stands_m = tops.top_m.data()[cells.cell.data()[pixel]];
        const bool is_canopy = stands_m <= of_block_m + kStandsOut_m && of_block_m > tolerated_m;
        tolerated_m = is_canopy ? of_block_m : tolerated_m;
    }
}

}  // namespace

void tolerateCanopy(const PixelCells& cells, const CellTops& tops, float sensor_height_m,
                    Image<float>& tolerance_m, const CellArea& area) {
    static_assert(kCanopyReach == kReach * kBlockCells + kBlockCells);
    const float tallest_m = std::min(kTallest_m, kTallestSeen * sensor_height_m);
    const BlockArea blocks = blocksIn(area);
    Blocks<Census> own{};
    countCells(tops, tallest_m, blocks, own);
    Blocks<Census> around = own;
    sumAround<kReach>(around, blocks);
    const auto isCanopy = [](const Census& census) { return census.isCanopy(); };
    if (std::none_of(around.begin(), around.end(), isCanopy)) return;  // usual case

    Blocks<Heights> heights;
    sumHeights(tops, tallest_m, own, heights);
    sumAround<kReach>(heights, blocks);
    BlocksAndNone<float> canopy_m{};
    for (std::size_t block = 0; block < around.size(); ++block) {
        if (!around[block].isCanopy()) continue;
        canopy_m[block] =
            canopyHeight_m(around[block].plants, heights[block].sum_m, heights[block].sum_m2);
    }
    raiseTolerances(cells, tops, canopy_m, tolerance_m);
}

}  // namespace hagen
