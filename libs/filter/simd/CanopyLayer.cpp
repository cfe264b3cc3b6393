#include "filter/simd/CanopyLayer.h"
#include <algorithm>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/CanopyLayer.cpp"
#include <hwy/foreach_target.h>
#include "filter/ground/BlockSums.h"
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

constexpr int kCells = GroundSurface::kCells;
using namespace canopy_rules;

/// Counts, for each row of a column of blocks: cells with returns, plus kTall times tall cells,
/// plus kPlants times cells with plants. `top_m` is the column's first cell.
void CountCellsIn(const float* HWY_RESTRICT top_m, float tallest_m,
                  std::int32_t* HWY_RESTRICT counts) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto tallest = hn::Set(d, tallest_m), lowest = hn::Set(d, kMinHeight_m);
    const auto one = hn::Set(di, 1), tall = hn::Set(di, 1 << 8), plant = hn::Set(di, 1 << 16);
    for (int i = 0; i < kCells; i += static_cast<int>(hn::Lanes(d))) {
        auto sum = hn::Zero(di);
        for (int j = 0; j < kBlockCells; ++j) {
            const auto top = hn::LoadU(d, top_m + j * kGridStride + i);
            const auto add = [&](auto is, auto what) HAGEN_INLINE {
                sum = hn::Add(sum, hn::IfThenElseZero(hn::RebindMask(di, is), what));
            };
            add(hn::Ne(top, hn::Set(d, CellTops::kNone_m)), one);
            add(hn::Ge(top, tallest), tall);
            add(hn::And(hn::Gt(top, lowest), hn::Lt(top, tallest)), plant);
        }
        hn::StoreU(sum, di, counts + i);
    }
}

/// Raises the tolerance of each pixel to the canopy of its block, unless an object in its cell
/// protrudes from it; NaN stays NaN.
void RaiseTolerancesIn(std::size_t pixels, const std::uint16_t* HWY_RESTRICT cell,
                       const std::uint16_t* HWY_RESTRICT block, const float* HWY_RESTRICT top_m,
                       const float* HWY_RESTRICT canopy_m, float* HWY_RESTRICT tolerance_m) {
    forEachVector(pixels, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const auto tolerated_m = hn::LoadU(d, tolerance_m + pixel);
        const auto of_block_m = gatherAt(d, canopy_m, block + pixel);
        const auto stands_m = gatherAt(d, top_m, cell + pixel);
        const auto is_canopy =
            hn::And(hn::Le(stands_m, hn::Add(of_block_m, hn::Set(d, kStandsOut_m))),
                    hn::Gt(of_block_m, tolerated_m));
        hn::StoreU(hn::IfThenElse(is_canopy, of_block_m, tolerated_m), d, tolerance_m + pixel);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(CountCellsIn);
HWY_EXPORT(RaiseTolerancesIn);

constexpr int kCells = GroundSurface::kCells;
using namespace canopy_rules;

/// Counts of the cells of one or more blocks, in one number so that sums are fast.
struct Census {
    static constexpr std::uint64_t kTall = std::uint64_t{1} << 20, kPlants = kTall << 20;
    std::uint64_t counts = 0;

    void add(const Census& other) { counts += other.counts; }
    void remove(const Census& other) { counts -= other.counts; }
    /// Cells whose highest return is a low plant.
    int plants() const { return static_cast<int>(counts / kPlants); }
    bool isCanopy() const {
        const auto seen = static_cast<float>(counts % kTall);          // cells with returns
        const auto tall = static_cast<float>(counts / kTall % kTall);  // above plants
        return seen >= kMinCells && static_cast<float>(plants()) >= kMinShare * seen &&
               tall <= kMaxTall * seen;
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

/// Counts the cells of each block; returns the number of cells with plants.
int countCells(const CellTops& tops, float tallest_m, const BlockArea& area,
               Blocks<Census>& blocks) {
    int plants = 0;
    for (int column = area.first_column; column < area.end_column; ++column) {
        std::int32_t counts[kCells];
        HWY_DYNAMIC_DISPATCH(CountCellsIn)
        (columnOf(tops, column * kBlockCells), tallest_m, counts);
        for (int block = area.first_row; block < area.end_row; ++block) {
            std::uint64_t sum = 0;
            for (int k = 0; k < kBlockCells; ++k) sum += counts[block * kBlockCells + k];
            Census& census = blocks[column * kBlocks + block];
            census.counts =
                sum % 256 + sum / 256 % 256 * Census::kTall + (sum >> 16) * Census::kPlants;
            plants += census.plants();
        }
    }
    return plants;
}

/// `own` contains the sums of each block. Most blocks have no plants.
void sumHeights(const CellTops& tops, float tallest_m, const Blocks<Census>& own,
                Blocks<Heights>& blocks) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        blocks[block] = {};
        if (own[block].plants() == 0) continue;
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

}  // namespace

void tolerateCanopy(const PixelCells& cells, const CellTops& tops, float sensor_height_m,
                    Image<float>& tolerance_m, const CellArea& area) {
    static_assert(kCanopyReach == kReach * kBlockCells + kBlockCells);
    const float tallest_m = std::min(kTallest_m, kTallestSeen * sensor_height_m);
    const BlockArea blocks = blocksIn(area);
    Blocks<Census> own{};
    const auto plants = static_cast<float>(countCells(tops, tallest_m, blocks, own));
    if (plants < kMinShare * kMinCells) return;
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
            canopyHeight_m(around[block].plants(), heights[block].sum_m, heights[block].sum_m2);
    }
    HWY_DYNAMIC_DISPATCH(RaiseTolerancesIn)
    (static_cast<std::size_t>(tolerance_m.size()), cells.cell.data(), cells.block.data(),
     tops.top_m.data(), canopy_m.data(), tolerance_m.data());
}

}  // namespace hagen
#endif
