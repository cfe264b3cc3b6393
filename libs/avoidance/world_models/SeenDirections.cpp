#include "avoidance/world_models/SeenDirections.h"

#include <algorithm>

namespace hagen::avoidance {

SeenDirections::Cell SeenDirections::cellOf(const Eigen::Vector3f& direction) {
    Eigen::Index axis;
    const float max = direction.cwiseAbs().maxCoeff(&axis);
    const float scale = max > 0 ? 0.5f * kCellsAcross / max : 0;
    const auto across = [&](Eigen::Index other) {
        const float at = direction[(axis + other) % 3] * scale + 0.5f * kCellsAcross;
        return std::clamp(static_cast<int>(at), 0, kCellsAcross - 1);
    };
    const int face = 2 * static_cast<int>(axis) + (direction[axis] < 0);
    return {face, across(1), across(2)};
}

void SeenDirections::see(const Eigen::Vector3f& from_origin_m) {
    constexpr float kMax_cm = kNone_cm - 1;
    const auto range_cm = static_cast<std::uint16_t>(std::min(kMax_cm, 100 * from_origin_m.norm()));
    Returns& returns = seen_[cellOf(from_origin_m).index()];
    returns.nearest_cm = std::min(returns.nearest_cm, range_cm);
    returns.farthest_cm = std::max(returns.farthest_cm, range_cm);
}

bool SeenDirections::isSeen(const Eigen::Vector3f& from_origin_m) const {
    return 100 * from_origin_m.norm() <=
           static_cast<float>(seen_[cellOf(from_origin_m).index()].farthest_cm);
}

/// Neighbours across an edge of the cube are omitted.
SeenDirections::Place SeenDirections::placeAt(const Eigen::Vector3f& from_origin_m) const {
    constexpr int kMinCells = 4;
    constexpr float kBehind_cm = 50;
    const Cell middle = cellOf(from_origin_m);
    int cells = 0;
    std::uint16_t nearest_cm = kNone_cm;
    Cell cell = middle;
    for (cell.row = std::max(0, middle.row - 1);
         cell.row <= std::min(kCellsAcross - 1, middle.row + 1); ++cell.row) {
        for (cell.column = std::max(0, middle.column - 1);
             cell.column <= std::min(kCellsAcross - 1, middle.column + 1); ++cell.column) {
            const Returns& returns = seen_[cell.index()];
            cells += returns.nearest_cm != kNone_cm;
            nearest_cm = std::min(nearest_cm, returns.nearest_cm);
        }
    }
    if (cells < kMinCells) return Place::Unknown;
    const bool is_free = static_cast<float>(nearest_cm) >= 100 * from_origin_m.norm() + kBehind_cm;
    return is_free ? Place::Free : Place::NotFree;
}

View viewOf(const observations::MappedScan& scan) {
    View view{scan.time_s, scan.origin_m, {}};
    double age_s = 0;
    for (const float one_s : scan.age_s) age_s += static_cast<double>(one_s);
    if (!scan.age_s.empty()) view.time_s -= age_s / static_cast<double>(scan.age_s.size());
    for (const Eigen::Vector3f& point_m : scan.points_m) view.seen.see(point_m - scan.origin_m);
    return view;
}

}  // namespace hagen::avoidance
