#pragma once
#include <Eigen/Core>
#include <vector>

namespace hagen::avoidance {

/// Of each cube of space that holds points the one nearest to where they were seen from. The cubes
/// lie side by side from there on. Neighbours come out near one another (along a Morton curve),
/// which k-d trees are built and searched faster for. Points have to be finite and within 500 cubes
/// of the origin.
std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& origin_m, float edge_m);

}  // namespace hagen::avoidance
