#include "SeenDirections.h"

#include <algorithm>
#include <cmath>

namespace hagen {

namespace {

constexpr float kMost_cm = 65535;
constexpr float kCell_rad = static_cast<float>(2 * M_PI / 180);

}  // namespace

std::size_t SeenDirections::cellOf(const Eigen::Vector3f& direction) {
    const float azimuth_rad = std::atan2(direction.y(), direction.x());
    const float elevation_rad = std::atan2(direction.z(), direction.head<2>().norm());
    const int column = static_cast<int>(std::floor(azimuth_rad / kCell_rad)) + kColumns / 2;
    const int row = static_cast<int>(std::lround(elevation_rad / kCell_rad)) + kRows / 2;
    return static_cast<std::size_t>(std::clamp(row, 0, kRows - 1) * kColumns +
                                    std::clamp(column, 0, kColumns - 1));
}

void SeenDirections::see(const Eigen::Vector3f& from_origin_m) {
    const float range_cm = std::min(kMost_cm, 100 * from_origin_m.norm());
    std::uint16_t& seen = seen_cm_[cellOf(from_origin_m)];
    seen = std::max(seen, static_cast<std::uint16_t>(range_cm));
}

bool SeenDirections::isSeen(const Eigen::Vector3f& from_origin_m) const {
    return 100 * from_origin_m.norm() <= static_cast<float>(seen_cm_[cellOf(from_origin_m)]);
}

}  // namespace hagen
