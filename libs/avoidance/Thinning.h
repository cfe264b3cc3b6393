#pragma once
#include <Eigen/Core>
#include <vector>

namespace hagen {

/// The first point of each cube of space that holds any, the cubes lying side by side from
/// `middle_m` on. Neighbours come out near one another (along a Morton curve), which k-d trees are
/// built and searched faster for. Points beyond 512 cubes from the middle, or not finite, are not
/// allowed.
std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points_m,
                                     const Eigen::Vector3f& middle_m, float edge_m);

}  // namespace hagen
