#pragma once
#include <Eigen/Core>

namespace hagen::simulation {

/// The way that a flight follows over a scene, seen from above: two straights along x, joined by
/// half circles, flown counter-clockwise from the middle of the southern straight. Scenes keep it
/// clear of whatever is solid.
struct Path {
    double half_straight_m = 30;
    double radius_m = 11.25;

    double length_m() const;
    Eigen::Vector2d at(double way_m) const;           ///< after this way, turns wrapped around
    double heading_rad(double way_m) const;           ///< counter-clockwise from x
    double curvature_per_m(double way_m) const;       ///< positive to the left
    double distance_m(double x_m, double y_m) const;  ///< from a place to the path
};

}  // namespace hagen::simulation
