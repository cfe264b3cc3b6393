#include "Thinning.h"

#include <algorithm>
#include <cstdint>

namespace hagen {
namespace {

/// Ten bits, with two zeros between one and the next.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    return (bits | bits << 2) & 0x09249249;
}

}  // namespace

std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& middle_m, float edge_m) {
    constexpr float kHalf = 512;
    std::vector<std::uint64_t> cubes_and_points;  // sorted as pairs would be, but sooner
    cubes_and_points.reserve(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        const Eigen::Array<std::uint32_t, 3, 1> cube =
            ((points_m[i] - middle_m).array() / edge_m + kHalf).cast<std::uint32_t>();
        const std::uint64_t curve =
            spread(cube.x()) << 2 | spread(cube.y()) << 1 | spread(cube.z());
        cubes_and_points.push_back(curve << 32 | i);
    }
    std::sort(cubes_and_points.begin(), cubes_and_points.end());
    const auto end = std::unique(cubes_and_points.begin(), cubes_and_points.end(),
                                 [](auto a, auto b) { return a >> 32 == b >> 32; });
    std::vector<Eigen::Vector3f> kept_m;
    kept_m.reserve(points_m.size());
    for (auto it = cubes_and_points.begin(); it != end; ++it) {
        kept_m.push_back(points_m[*it & 0xffffffff]);
    }
    return kept_m;
}

}  // namespace hagen
