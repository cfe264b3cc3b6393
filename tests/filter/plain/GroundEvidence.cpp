#include <algorithm>
#include <cmath>
#include <limits>

#include "filter/ground/BlockSums.h"
#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {
namespace {

using namespace evidence_rules;

/// Whether two pixels of a column form a level step.
bool isStep(const PixelPoints& pixels, Eigen::Index low, Eigen::Index high) {
    const Eigen::Vector3f below = pixels.at(low);
    const auto length_m2 = [&](const Eigen::Vector3f& step) {
        return step.x() * step.x() + step.y() * step.y() + step.z() * step.z();
    };
    for (Eigen::Index between = low + 1; between < high; ++between) {  // must be empty or close
        if (length_m2(pixels.at(between) - below) >= kShort_m * kShort_m) return false;
    }
    const Eigen::Vector3f step = pixels.at(high) - below;
    if (high > low + 1 && !(length_m2(step) < kFar_m * kFar_m)) return false;
    const float run_m2 = step.x() * step.x() + step.y() * step.y();
    const float outwards = step.x() * below.x() + step.y() * below.y();
    return outwards > 0 && step.z() * step.z() < kSteepest * kSteepest * run_m2;
}

/// Whether most near-surface pixels around a block are level. `close` and `level` are pixel counts
/// per block.
using Counts = Eigen::Array<int, kBlocks, kBlocks>;
bool hasEvidence(const Counts& close, const Counts& level, int i, int j) {
    const int first_i = std::max(i - kReach, 0), first_j = std::max(j - kReach, 0);
    const int size_i = std::min(i + kReach + 1, kBlocks) - first_i;
    const int size_j = std::min(j + kReach + 1, kBlocks) - first_j;
    const int all = close.block(first_i, first_j, size_i, size_j).sum();
    const int flat = level.block(first_i, first_j, size_i, size_j).sum();
    return flat > 0 && static_cast<float>(flat) >= kMinShare * static_cast<float>(all);
}

}  // namespace

void findLevelPixels(const PixelPoints& pixels, const PixelCells& cells,
                     Image<std::uint8_t>& is_level) {
    const Eigen::Index rows = pixels.x_m.rows(), size = pixels.x_m.size();
    std::vector<float> lowest_m(kGridSize, kNoHeight);
    for (Eigen::Index pixel = 0; pixel < size; ++pixel) {
        const float z_m = pixels.z_m.data()[pixel];
        float& low_m = lowest_m[cells.cell.data()[pixel]];
        if (z_m < low_m) low_m = z_m;  // ignores NaN
    }
    is_level.setZero(rows, pixels.x_m.cols());
    for (Eigen::Index low = 0; low < size; ++low) {
        const Eigen::Index end = std::min(low + kAbove + 1, (low / rows + 1) * rows);
        for (Eigen::Index high = low + 1; high < end; ++high) {
            if (!isStep(pixels, low, high)) continue;
            is_level.data()[low] = is_level.data()[high] = 1;
        }
    }
    for (Eigen::Index pixel = 0; pixel < size; ++pixel) {
        const float low_m = lowest_m[cells.cell.data()[pixel]];
        if (!(pixels.z_m.data()[pixel] <= low_m + kDrop_m)) is_level.data()[pixel] = 0;
    }
}

void requireEvidence(const PixelPoints& pixels, const PixelCells& cells,
                     const Image<float>& height_m, const Image<std::uint8_t>& is_level,
                     float sensor_height_m, Image<float>& tolerance_m,
                     std::vector<std::uint8_t>& has_evidence) {
    Counts close = Counts::Zero(), level = Counts::Zero();
    for (Eigen::Index pixel = 0; pixel < height_m.size(); ++pixel) {
        const float x_m = pixels.x_m.data()[pixel], y_m = pixels.y_m.data()[pixel];
        const float max_m = kClose_m + kClose_per_m * std::sqrt(x_m * x_m + y_m * y_m);
        const std::uint16_t block = cells.block.data()[pixel];
        if (block == PixelCells::kNoBlock) continue;
        if (!(std::abs(height_m.data()[pixel]) < max_m)) continue;
        ++close.data()[block];
        level.data()[block] += is_level.data()[pixel];
    }
    has_evidence.assign(kBlocks * kBlocks + 1, 0);  // last element: beyond the grid
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        has_evidence[block] = hasEvidence(close, level, block % kBlocks, block / kBlocks) &&
                              sensor_height_m > kLowest_m &&
                              blockDistance_m(block) < kSight * sensor_height_m;
    }
    for (Eigen::Index pixel = 0; pixel < tolerance_m.size(); ++pixel) {
        float& tolerated_m = tolerance_m.data()[pixel];
        if (hasValue(tolerated_m) && has_evidence[cells.block.data()[pixel]] == 0) {
            tolerated_m = -std::numeric_limits<float>::infinity();
        }
    }
}

}  // namespace hagen::plain
