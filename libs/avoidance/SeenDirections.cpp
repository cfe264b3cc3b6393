#include "SeenDirections.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {

std::size_t SeenDirections::cellOf(const Eigen::Vector3f& direction) {
    Eigen::Index axis;
    const float most = direction.cwiseAbs().maxCoeff(&axis);
    const float scale = most > 0 ? 0.5f * kCellsAcross / most : 0;
    const auto across = [&](Eigen::Index other) {
        const float at = direction[(axis + other) % 3] * scale + 0.5f * kCellsAcross;
        return std::clamp(static_cast<int>(at), 0, kCellsAcross - 1);
    };
    const int face = 2 * static_cast<int>(axis) + (direction[axis] < 0);
    return static_cast<std::size_t>((face * kCellsAcross + across(1)) * kCellsAcross + across(2));
}

void SeenDirections::see(const Eigen::Vector3f& from_origin_m) {
    constexpr float kMost_cm = 65535;
    const float range_cm = std::min(kMost_cm, 100 * from_origin_m.norm());
    std::uint16_t& seen = seen_cm_[cellOf(from_origin_m)];
    seen = std::max(seen, static_cast<std::uint16_t>(range_cm));
}

bool SeenDirections::isSeen(const Eigen::Vector3f& from_origin_m) const {
    return 100 * from_origin_m.norm() <= static_cast<float>(seen_cm_[cellOf(from_origin_m)]);
}

}  // namespace hagen::avoidance
