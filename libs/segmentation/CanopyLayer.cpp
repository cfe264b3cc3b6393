#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/GroundSurface.h>
#include <algorithm>
#include <cmath>

namespace hagen {
namespace {

constexpr int kCells = GroundSurface::kCells;
constexpr int kBlockCells = 4;
constexpr int kBlocks = kCells / kBlockCells;  // along each side, 3 m each
constexpr int kReach = 6;                      // blocks to each side

constexpr float kLowest_m = 0.1f, kTallest_m = 1.0f;  // of what may be a canopy
constexpr float kLeastShare = 0.35f;                  // of the cells seen around
constexpr float kLeastCells = 30;                     // seen around; fewer tell nothing
constexpr float kDeviations = 2.0f;
constexpr float kMargin_m = 0.1f;

/// The cell of a coordinate, or -1 beyond the grid.
int cellOf(float coordinate_m) {
    const float cell = std::floor(coordinate_m / GroundSurface::kCell_m) + 0.5f * kCells;
    return cell >= 0 && cell < kCells ? static_cast<int>(cell) : -1;
}

/// What stands in the cells of a block, or of many.
struct Stand {
    float seen = 0;    ///< cells with returns
    float plants = 0;  ///< of those, cells whose highest return is that of a low plant
    float sum_m = 0;   ///< of the plants' heights
    float sum_m2 = 0;  ///< of their squares

    void addCell(float top_m) {
        seen += 1;
        if (!(top_m > kLowest_m && top_m < kTallest_m)) return;
        plants += 1;
        sum_m += top_m;
        sum_m2 += top_m * top_m;
    }
    void add(const Stand& other) {
        seen += other.seen;
        plants += other.plants;
        sum_m += other.sum_m;
        sum_m2 += other.sum_m2;
    }
    /// The height that no plant exceeds; 0 where there is no canopy.
    float canopy_m() const {
        if (seen < kLeastCells || plants < kLeastShare * seen) return 0;
        const float mean_m = sum_m / plants;
        const float variance_m2 = std::max(sum_m2 / plants - mean_m * mean_m, 0.0f);
        return mean_m + kDeviations * std::sqrt(variance_m2) + kMargin_m;
    }
};
using Stands = Eigen::Array<Stand, Eigen::Dynamic, Eigen::Dynamic>;

/// The sums over kReach blocks to each side, along the first index.
Stands sumsAlong(const Stands& stands) {
    Stands sums(kBlocks, kBlocks);
    for (int j = 0; j < kBlocks; ++j) {
        for (int i = 0; i < kBlocks; ++i) {
            const int first = std::max(i - kReach, 0), last = std::min(i + kReach, kBlocks - 1);
            for (int k = first; k <= last; ++k) sums(i, j).add(stands(k, j));
        }
    }
    return sums;
}

}  // namespace

void tolerateCanopy(const PixelPoints& pixels, const Image<float>& height_m,
                    Image<float>& tolerance_m) {
    Eigen::ArrayXXf top_m = Eigen::ArrayXXf::Constant(kCells, kCells, kNoValue);
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float h_m = height_m.data()[pixel];
        if (!hasValue(h_m)) continue;
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        if (i < 0 || j < 0) continue;
        if (!(top_m(i, j) >= h_m)) top_m(i, j) = h_m;
    }
    Stands stands(kBlocks, kBlocks);
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            if (hasValue(top_m(i, j)))
                stands(i / kBlockCells, j / kBlockCells).addCell(top_m(i, j));
        }
    }
    const Stands around = sumsAlong(sumsAlong(stands).transpose()).transpose();
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        if (!hasValue(height_m.data()[pixel])) continue;
        const int i = cellOf(pixels.x_m.data()[pixel]), j = cellOf(pixels.y_m.data()[pixel]);
        if (i < 0 || j < 0) continue;
        float& tolerated_m = tolerance_m.data()[pixel];
        tolerated_m = std::max(tolerated_m, around(i / kBlockCells, j / kBlockCells).canopy_m());
    }
}

}  // namespace hagen
