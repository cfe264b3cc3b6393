#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/GroundSurface.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "BlockSums.h"

namespace hagen {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr int kReach = 6;  // blocks in each direction

constexpr float kLowest_m = 0.1f, kTallest_m = 1.0f;  // of a canopy's plants
constexpr float kLeastShare = 0.35f;                  // of the cells seen nearby
constexpr float kMostTall = 0.2f;                     // share of higher cells: walls, trees
constexpr float kLeastCells = 30;                     // seen nearby; with fewer, no canopy
constexpr double kDeviations = 2.0;
constexpr double kMargin_m = 0.1;
constexpr float kStandsOut_m = 0.1f;  // above the canopy: an obstacle in it

/// The plants in the cells of one or more blocks. Sums are double, so that subtracting a block
/// leaves hardly any rounding error.
struct Stand {
    float seen = 0;     ///< cells with returns
    float tall = 0;     ///< cells whose highest return is higher than plants
    float plants = 0;   ///< cells whose highest return is that of a low plant
    double sum_m = 0;   ///< sum of the plants' heights
    double sum_m2 = 0;  ///< sum of their squares

    void addCell(float top_m) {
        seen += 1;
        tall += top_m >= kTallest_m ? 1.0f : 0.0f;
        if (!(top_m > kLowest_m && top_m < kTallest_m)) return;
        plants += 1;
        sum_m += top_m;
        sum_m2 += static_cast<double>(top_m) * top_m;
    }
    void add(const Stand& other) {
        seen += other.seen;
        tall += other.tall;
        plants += other.plants;
        sum_m += other.sum_m;
        sum_m2 += other.sum_m2;
    }
    void remove(const Stand& other) {
        seen -= other.seen;
        tall -= other.tall;
        plants -= other.plants;
        sum_m -= other.sum_m;
        sum_m2 -= other.sum_m2;
    }
    /// The height that plants do not exceed; 0 without a canopy.
    float canopy_m() const {
        if (seen < kLeastCells || plants < kLeastShare * seen) return 0;
        if (tall > kMostTall * seen) return 0;
        const double mean_m = sum_m / plants;
        const double variance_m2 = std::max(sum_m2 / plants - mean_m * mean_m, 0.0);
        return static_cast<float>(mean_m + kDeviations * std::sqrt(variance_m2) + kMargin_m);
    }
};
constexpr float kNothing_m[kBlockCells] = {CellTops::kNone_m, CellTops::kNone_m, CellTops::kNone_m,
                                           CellTops::kNone_m};

void findStands(const CellTops& tops, Blocks<Stand>& stands) {
    for (int j = 0; j < kCells; ++j) {
        const float* const column_m = tops.highest_m.col(j + 1).data() + 1;  // without the border
        for (int block = 0; block < kBlocks; ++block) {
            const float* const top_m = column_m + block * kBlockCells;
            // Most blocks are empty. kNone_m is always written as this constant, so bits compare.
            // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
            if (std::memcmp(top_m, kNothing_m, sizeof(kNothing_m)) == 0) continue;
            Stand& stand = stands[j / kBlockCells * kBlocks + block];
            for (int k = 0; k < kBlockCells; ++k) {
                if (top_m[k] != CellTops::kNone_m) stand.addCell(top_m[k]);
            }
        }
    }
}

/// Raises the tolerance of each pixel to the canopy of its cell; NaN stays NaN. `of_cells_m` is
/// workspace.
void raiseTolerances(const CellTops& tops, const Blocks<float>& canopy_m, Image<float>& tolerance_m,
                     Eigen::ArrayXXf& of_cells_m) {
    of_cells_m.setZero(kCells + 2, kCells + 2);  // with a border, as in `tops`
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        of_cells_m.block<kBlockCells, kBlockCells>(
            1 + block % kBlocks * kBlockCells, 1 + block / kBlocks * kBlockCells) = canopy_m[block];
    }
    for (Eigen::Index cell = 0; cell < of_cells_m.size(); ++cell) {
        float& of_cell_m = of_cells_m.data()[cell];
        of_cell_m = tops.top_m.data()[cell] > of_cell_m + kStandsOut_m ? 0 : of_cell_m;
    }
    for (Eigen::Index pixel = 0; pixel < tolerance_m.size(); ++pixel) {
        float& tolerated_m = tolerance_m.data()[pixel];
        const float of_cell_m = of_cells_m.data()[tops.cell.data()[pixel]];
        tolerated_m = of_cell_m > tolerated_m ? of_cell_m : tolerated_m;
    }
}

}  // namespace

void tolerateCanopy(const CellTops& tops, Image<float>& tolerance_m, CanopyWorkspace& work) {
    Blocks<Stand> stands{};
    findStands(tops, stands);
    sumAround<kReach>(stands);

    Blocks<float> canopy_m;
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        canopy_m[block] = stands[block].canopy_m();
    }
    if (*std::max_element(canopy_m.begin(), canopy_m.end()) == 0) return;  // nearly always
    raiseTolerances(tops, canopy_m, tolerance_m, work.canopy_m);
}

}  // namespace hagen
