#include "avoidance/world_models/Thinning.h"

#include <algorithm>

namespace hagen::avoidance {
namespace {

/// Spreads ten bits, inserting two zeros after each.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    return (bits | bits << 2) & 0x09249249;
}

std::uint32_t placeOnCurve(const Eigen::Array3f& at_cubes) {
    constexpr float kMiddle = 512;
    const auto cube = (at_cubes + kMiddle).cast<std::uint32_t>().eval();
    return spread(cube.x()) << 2 | spread(cube.y()) << 1 | spread(cube.z());
}

}  // namespace

std::vector<ThinnedPoint> thinnedPoints(const std::vector<Eigen::Vector3f>& points_m,
                                        const Eigen::Vector3f& origin_m, float edge_m) {
    std::vector<std::uint64_t> cubes_and_points;  // sorted like pairs, but faster
    cubes_and_points.reserve(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        const std::uint64_t cube = placeOnCurve((points_m[i] - origin_m).array() / edge_m);
        cubes_and_points.push_back(cube << 32 | i);
    }
    std::sort(cubes_and_points.begin(), cubes_and_points.end());

    const auto distance_m2 = [&](std::uint32_t i) {
        return (points_m[i] - origin_m).squaredNorm();
    };
    std::vector<ThinnedPoint> kept;
    kept.reserve(points_m.size());
    std::uint64_t last = ~std::uint64_t{0};
    for (const std::uint64_t cube_and_point : cubes_and_points) {
        const auto point = static_cast<std::uint32_t>(cube_and_point & 0xffffffff);
        if (cube_and_point >> 32 != last) {
            kept.push_back({point, 1});
        } else {
            ++kept.back().of_points;
            if (distance_m2(point) < distance_m2(kept.back().index)) kept.back().index = point;
        }
        last = cube_and_point >> 32;
    }
    return kept;
}

std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& origin_m, float edge_m) {
    std::vector<Eigen::Vector3f> kept_m;
    for (const ThinnedPoint& point : thinnedPoints(points_m, origin_m, edge_m)) {
        kept_m.push_back(points_m[point.index]);
    }
    return kept_m;
}

}  // namespace hagen::avoidance
