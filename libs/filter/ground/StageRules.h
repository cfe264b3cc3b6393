// Constants of the ground stages. Distances are in metres, slopes in metres per metre. [halved,
// doubled] is the change of RoI F1, in points, on the data set where it changes most; missed
// returns and all sets: docs/results/sensitivity.csv.
#pragma once
#include <algorithm>
#include <cmath>

namespace hagen {

namespace frame_rules {
constexpr float kCell_m = 0.75f;          // width of a grid cell; fixed
constexpr float kReach_m = 40.0f;         // size of the grid in each direction; fixed
constexpr int kCells = 107;               // 2 kReach_m / kCell_m, rounded up
constexpr int kEnoughColumns = 200;       // wider images are sampled [+0.03, +0.02]
constexpr int kRounds = 6;                // rounds of reweighted least squares [+0.01, +0.03]
constexpr double kFirstScale_m = 1.0;     // scale of residuals in the first round [-0.01, +0.02]
constexpr double kScaleStep = 0.8;        // factor of the scale per round [-0.01, -0.05]
constexpr double kMinScale_m = 0.3;       // minimum scale of residuals [0, +0.02]
constexpr double kAbove = 2.0;            // decrease of weights above the ground [+0.02, +0.03]
constexpr double kBelow = 1.0;            // and below the ground [+0.04, +0.01]
constexpr double kRangeScale_m2 = 400.0;  // (20 m)^2: weights decrease with range [+0.01, -0.01]
}  // namespace frame_rules

namespace surface_rules {
constexpr int kEnoughColumns = 200;  // wider images are sampled for the coarse fit [0, -0.03]
constexpr float kStray_m = 0.4f;     // lower cells are not ground [0, 0]
constexpr int kStrayNeighbours = 3;  // min. number of higher neighbours of a stray [-0.01, -0.01]
constexpr float kSteepest = 0.3f;    // maximum slope of visible ground [-0.10, -0.23]
constexpr float kSteepestUnseen = 0.15f;  // of ground hidden by objects [-0.05, -0.52]
constexpr float kDiagonal = 1.41421356f;  // distance of diagonal neighbours, in cells
constexpr float kEnvelope_m = 0.15f;      // maximum height above the steepest slopes [+0.02, -0.01]
constexpr float kAboveLowest_m = 0.05f;   // max. height above the lowest candidate [+0.19, -0.44]
constexpr float kBelowLowest_m = 0.1f;    // max. depth below it [0, 0]
constexpr float kSureReturns = 5;         // returns for full weight of a mean [-0.20, +0.20]
constexpr float kClose_m = 0.2f;          // max. distance to the coarse surface [+0.29, -0.67]
constexpr float kCloseBelow_per_m = 0.01f;   // and per metre of range, below it [-0.04, +0.01]
constexpr float kCloseAbove_per_m = 0.005f;  // and above it [+0.11, -0.19]
}  // namespace surface_rules

namespace evidence_rules {
constexpr float kSteepest = 0.3f;       // maximum slope of a level step [+0.03, -0.01]
constexpr float kShort_m = 0.08f;       // shorter steps are too noisy [0, 0]
constexpr float kFar_m = 2.0f;          // maximum length of a step over other pixels [0, 0]
constexpr float kDrop_m = 0.3f;         // max. height above the cell's lowest pixel [+0.01, -0.01]
constexpr int kAbove = 4;               // maximum rows of a step [0, 0]
constexpr float kClose_m = 0.2f;        // max. distance to the surface [0, 0]
constexpr float kClose_per_m = 0.005f;  // and per metre of range [0, 0]
constexpr float kMinShare = 0.55f;      // level pixels / close pixels [-0.01, -42.9]
constexpr int kReach = 4;               // blocks in each direction; fixed
constexpr float kLowest_m = 0.1f;       // minimum height of the sensor above the surface [0, 0]
constexpr float kSight = 40;            // maximum distance, in sensor heights [0, 0]
}  // namespace evidence_rules

namespace tops_rules {
constexpr float kOverhead_m = 1.5f;  // higher returns may overhang [-4.64, -0.04]
}

namespace tolerance_rules {
constexpr float kMinTolerance_m = 0.04f;  // [0, -0.04]
constexpr float kTallest_m = 1.1f;        // limit of the height of tops [-1.16, -0.15]
constexpr float kShallow = 3;  // in sensor heights: distance of full reduction [-0.02, -0.64]
}  // namespace tolerance_rules

namespace canopy_rules {
constexpr int kReach = 6;             // blocks in each direction; fixed
constexpr float kMinHeight_m = 0.1f;  // minimum height of plants [-0.01, -3.92]
constexpr float kTallest_m = 1.0f;    // maximum height of plants [-0.04, -15.9]
constexpr float kTallestSeen = 3;     // and in sensor heights [0, 0]
constexpr float kMinShare = 0.35f;    // share of plants among nearby cells [-0.68, -4.25]
constexpr float kMaxTall = 0.2f;      // share of higher cells (walls, trees) [0, -0.01]
constexpr float kMinCells = 30;       // nearby cells required for a canopy [0, 0]
constexpr double kDeviations = 2.0;   // canopy height: mean + kDeviations * sd [-0.07, 0]
constexpr double kMargin_m = 0.1;     // margin added to the canopy height [-0.01, 0]
constexpr float kStandsOut_m = 0.1f;  // min. height of an obstacle above the canopy [0, 0]

/// The height that plants do not exceed, from the sums of their heights and squared heights.
inline float canopyHeight_m(int plants, double sum_m, double sum_m2) {
    const double mean_m = sum_m / plants;
    const double variance_m2 = std::max(sum_m2 / plants - mean_m * mean_m, 0.0);
    const double spread_m = std::min(kDeviations * std::sqrt(variance_m2), mean_m);
    return static_cast<float>(mean_m + spread_m + kMargin_m);
}
}  // namespace canopy_rules

namespace feet_rules {
constexpr float kFootHeight_m = 0.015f;  // minimum height of a foot [+0.09, -0.19]
constexpr int kFootRows = 4;             // maximum rows from a foot up to the obstacle [0, 0]
}  // namespace feet_rules

namespace speck_rules {
constexpr float kDoubt_m = 0.2f;  // heights this close to the tolerance are voted on [+0.05, -0.03]
constexpr float kSteps_per_m = 64;     // distances are rounded to these steps
constexpr float kFarthest_m = 511.0f;  // 511 m in these steps fits into 16 bits
constexpr int kVoteReach = 64;         // steps (1 m) of distance from the sensor [+0.08, -0.24]
constexpr int kMinVotes = 3;           // including the pixel's own vote [0, +0.03]
}  // namespace speck_rules

}  // namespace hagen
