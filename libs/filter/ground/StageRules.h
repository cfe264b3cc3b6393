// The numbers of the ground stages, for their definitions and for simd/. Distances are in metres,
// slopes in metres per metre; each stage's header gives the reasons. Halved and doubled, they
// change the scores as in docs/results/sensitivity.csv (scripts/measure-sensitivity).
#pragma once
#include <algorithm>
#include <cmath>

namespace hagen {

namespace frame_rules {
constexpr float kCell_m = 0.75f;
constexpr float kReach_m = 40.0f;
constexpr int kCells = 107;          // 2 kReach_m / kCell_m, rounded up
constexpr int kEnoughColumns = 200;  // of an image
constexpr int kRounds = 6;
constexpr double kFirstScale_m = 1.0;  // of residuals, in the first round
constexpr double kScaleStep = 0.8;
constexpr double kMinScale_m = 0.3;
constexpr double kAbove = 2.0, kBelow = 1.0;  // weights fall faster above the ground
constexpr double kRangeScale_m2 = 400.0;      // 20 m, squared
}  // namespace frame_rules

namespace surface_rules {
constexpr int kEnoughColumns = 200;  // of an image, for the coarse fit
constexpr float kStray_m = 0.4f;     // ground is never this far below its neighbours
constexpr int kStrayNeighbours = 3;
constexpr float kSteepest = 0.3f;         // maximum slope of visible ground against its plane
constexpr float kSteepestUnseen = 0.15f;  // and of hidden ground: tall objects hide it, not hills
constexpr float kDiagonal = 1.41421356f;  // distance of diagonal neighbours, in cells
constexpr float kEnvelope_m = 0.15f;      // maximum height of a cell above the steepest slopes
constexpr float kAboveLowest_m = 0.05f, kBelowLowest_m = 0.1f;  // candidates close to the lowest
constexpr float kSureReturns = 5;  // a mean over this many has full weight
// Pixels are close to the coarse surface between these heights, which grow with distance.
constexpr float kClose_m = 0.2f, kCloseBelow_per_m = 0.01f, kCloseAbove_per_m = 0.005f;
}  // namespace surface_rules

namespace evidence_rules {
constexpr float kSteepest = 0.3f;  // slope of a level step
constexpr float kShort_m = 0.08f;  // a step as short as this is too noisy
constexpr float kFar_m = 2.0f;     // no step over other pixels is longer
constexpr float kDrop_m = 0.3f;    // no pixel of a cell is farther below a level pixel
constexpr int kAbove = 4;          // a step leads to one of this many pixels above
constexpr float kClose_m = 0.2f, kClose_per_m = 0.005f;  // to the surface
constexpr float kMinShare = 0.55f;                       // of level pixels among the close ones
constexpr int kReach = 4;                                // blocks in each direction
}  // namespace evidence_rules

namespace tops_rules {
constexpr float kOverhead_m = 1.5f;  // a higher object need not stand in its cell
}

namespace tolerance_rules {
constexpr float kMinTolerance_m = 0.04f;
constexpr float kTallest_m = 1.1f;  // taller objects do not reduce the tolerance further
constexpr float kShallow = 3;       // distance per height of the sensor from which they fully do
}  // namespace tolerance_rules

namespace canopy_rules {
constexpr int kReach = 6;                                // blocks in each direction
constexpr float kMinHeight_m = 0.1f, kTallest_m = 1.0f;  // of a canopy's plants
constexpr float kMinShare = 0.35f;                       // of the cells seen nearby
constexpr float kMaxTall = 0.2f;                         // share of higher cells: walls, trees
constexpr float kMinCells = 30;                          // seen nearby; with fewer, no canopy
constexpr double kDeviations = 2.0;
constexpr double kMargin_m = 0.1;
constexpr float kStandsOut_m = 0.1f;  // above the canopy: an obstacle in it

/// Whether cells with returns are a canopy, by how many are higher than plants and how many are as
/// high as plants.
inline bool isCanopy(int seen, int tall, int plants) {
    const auto all = static_cast<float>(seen);
    return all >= kMinCells && static_cast<float>(plants) >= kMinShare * all &&
           static_cast<float>(tall) <= kMaxTall * all;
}

/// The height that plants do not exceed, by the sums of their heights and of the squares of these.
inline float canopyHeight_m(int plants, double sum_m, double sum_m2) {
    const double mean_m = sum_m / plants;
    const double variance_m2 = std::max(sum_m2 / plants - mean_m * mean_m, 0.0);
    const double spread_m = std::min(kDeviations * std::sqrt(variance_m2), mean_m);
    return static_cast<float>(mean_m + spread_m + kMargin_m);
}
}  // namespace canopy_rules

namespace feet_rules {
constexpr float kFootHeight_m = 0.015f;  // minimum height of a foot
constexpr int kFootRows = 4;             // maximum rows from a foot up to the obstacle
}  // namespace feet_rules

namespace speck_rules {
constexpr float kDoubt_m = 0.2f;       // heights this close to the tolerance are voted on
constexpr float kSteps_per_m = 64;     // distances are rounded to these steps
constexpr float kFarthest_m = 511.0f;  // in such steps, it still fits into 16 bits
constexpr int kVoteReach = 64;         // steps: 1 m, in distance from the sensor
constexpr int kMinVotes = 3;
}  // namespace speck_rules

}  // namespace hagen
