#pragma once
#include <Eigen/Core>
#include <vector>

namespace hagen::avoidance {

/// Keeps one point per cube of edge `edge_m`: the one nearest to the origin. The grid of cubes
/// starts at the origin. The result is in Morton order, which makes k-d trees faster to build and
/// search. Points must be finite and within 500 cubes of the origin.
std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& origin_m, float edge_m);

}  // namespace hagen::avoidance
