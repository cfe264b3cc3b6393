#pragma once
#include <Eigen/Core>

namespace hagen {

/// From a point to a cube, 0 in it: what an occupied voxel claims is that something is in it,
/// which may be at the side that faces the point.
inline float distanceToCube_m(const Eigen::Vector3f& point_m, const Eigen::Vector3f& middle_m,
                              float edge_m) {
    const Eigen::Array3f beyond = (point_m - middle_m).array().abs() - edge_m / 2;
    return beyond.max(0).matrix().norm();
}

/// How far beyond the bounds of a flight maps reach: what stands there is in the way of one that
/// goes along the edge.
constexpr float kMapMargin_m = 1.0f;

}  // namespace hagen
