#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// A point that represents all points of a cube.
struct ThinnedPoint {
    std::uint32_t index;      ///< among all points
    std::uint32_t of_points;  ///< number of points in the cube
};

/// Keeps one point per cube of edge `edge_m`: the one nearest to the origin. The grid of cubes
/// starts at the origin. Returns them in Morton order, which makes k-d trees faster to build and
/// search. Points must be finite and within 500 cubes of the origin.
std::vector<ThinnedPoint> thinnedPoints(const std::vector<Eigen::Vector3f>& points_m,
                                        const Eigen::Vector3f& origin_m, float edge_m);

/// Like thinnedPoints(), but returns coordinates.
std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& origin_m, float edge_m);

}  // namespace hagen::avoidance
