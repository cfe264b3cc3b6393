#pragma once
#include <Eigen/Core>

namespace hagen::simulation {

/// The closed path of a flight over a scene, in top view: two straights along x, joined by half
/// circles, flown counter-clockwise from the centre of the southern straight. Scenes have no solid
/// objects near the path.
struct Path {
    double half_straight_m = 30;
    double radius_m = 11.25;

    double length_m() const;
    Eigen::Vector2d at(double way_m) const;      ///< position at this path length (modulo the lap)
    double heading_rad(double way_m) const;      ///< counter-clockwise from x
    double curvature_per_m(double way_m) const;  ///< positive in left turns
    double distance_m(double x_m, double y_m) const;  ///< distance from the path
};

}  // namespace hagen::simulation
