#include "evaluation/TrueHeights.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "evaluation/PlanTree.h"

namespace hagen::evaluation {
namespace {

constexpr float kMaxRange_m = 10000;  // above the range of any LiDAR; limits cell numbers

/// The median; for an even number of values, the upper of the two.
float medianOf(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

using Cell = std::pair<std::int32_t, std::int32_t>;

Cell cellOf(const Eigen::Vector3f& point_m) {
    return {static_cast<std::int32_t>(std::floor(point_m.x() / kGroundCell_m)),
            static_cast<std::int32_t>(std::floor(point_m.y() / kGroundCell_m))};
}

Eigen::Vector2f centreOf(const Cell& cell) {
    return kGroundCell_m * Eigen::Vector2f(static_cast<float>(cell.first) + 0.5f,
                                           static_cast<float>(cell.second) + 0.5f);
}

/// Median heights of the cells with ground.
class GroundCells {
 public:
    GroundCells(const std::vector<Label>& truth, const std::vector<Eigen::Vector3f>& points_m) {
        std::map<Cell, std::vector<float>> heights_of_cell;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] != Label::Rou || !points_m[i].allFinite()) continue;
            heights_of_cell[cellOf(points_m[i])].push_back(points_m[i].z());
        }
        std::vector<Eigen::Vector2f> centres_m;
        for (auto& [cell, heights_m] : heights_of_cell) {
            heights_m_.push_back(medianOf(heights_m));
            centres_m.push_back(centreOf(cell));
        }
        tree_ = std::make_unique<PlanTree>(std::move(centres_m));
    }

    /// The ground below this cell; minus infinity if unknown.
    float groundOf(const Cell& cell) const {
        if (heights_m_.empty()) return -std::numeric_limits<float>::infinity();
        // Tolerates rounding; different squared distances between centres differ by 0.25 m2.
        constexpr float kOrEqual_m2 = 0.1f;
        const Eigen::Vector2f at_m = centreOf(cell);
        std::vector<std::uint32_t> near =
            tree_->within(at_m, kGroundNear_m * kGroundNear_m + kOrEqual_m2);
        if (near.empty()) {
            const float last_m2 = tree_->squaredDistanceOf(kGroundCells, at_m);
            near = tree_->within(at_m, 1.0001f * last_m2 + kOrEqual_m2);
        }
        std::vector<float> heights_m;
        heights_m.reserve(near.size());
        for (const std::uint32_t i : near) heights_m.push_back(heights_m_[i]);
        return medianOf(heights_m);
    }

 private:
    std::vector<float> heights_m_;
    std::unique_ptr<PlanTree> tree_;
};

}  // namespace

std::vector<Eigen::Vector3f> levelPoints(const GroundTruthScan& scan) {
    const Scan& returns = scan.input.scan;
    const Eigen::Matrix3f level = scan.levelFromSensor();
    std::vector<Eigen::Vector3f> points_m(returns.size());
    for (std::size_t i = 0; i < returns.size(); ++i) {
        const Eigen::Vector3f point_m(returns.x_m[i], returns.y_m[i], returns.z_m[i]);
        const bool is_somewhere = returns.range_m[i] < kMaxRange_m;  // false for NaN
        points_m[i] = is_somewhere ? Eigen::Vector3f(level * point_m)
                                   : Eigen::Vector3f::Constant(std::nanf(""));
    }
    return points_m;
}

std::vector<float> heightsAboveTrueGround(const GroundTruthScan& scan,
                                          const std::vector<Eigen::Vector3f>& points_m,
                                          float max_range_m) {
    const GroundCells ground(scan.truth, points_m);
    std::map<Cell, float> ground_of_cell;
    std::vector<float> heights_m(points_m.size(), std::nanf(""));
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (scan.truth[i] != Label::Roi || !(scan.input.scan.range_m[i] <= max_range_m)) continue;
        if (!points_m[i].allFinite()) continue;  // belongs to no cell
        const Cell cell = cellOf(points_m[i]);
        const auto [at, is_new] = ground_of_cell.try_emplace(cell, 0.0f);
        if (is_new) at->second = ground.groundOf(cell);
        heights_m[i] = points_m[i].z() - at->second;
    }
    return heights_m;
}

}  // namespace hagen::evaluation
