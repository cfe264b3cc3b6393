#pragma once
#include "simulation/SceneBuilder.h"

namespace hagen::simulation {

// The origin of these shapes is on the ground.
Shape makeRod(double height_m, double radius_m);
Shape makeCar(Random& random);  ///< x forward
Shape makeHouse(double length_m, double width_m, double wall_m, Random& random);
Shape makeRock(Random& random);  ///< about 1 m across
Shape makePerson();
Shape makeDrone();

// These objects follow the ground.

/// Adds a wall along a line, in short pieces that follow the ground.
void addWall(SceneBuilder& builder, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
             double height_m, double thickness_m);
/// Adds three walls, open in the direction `yaw_rad`. `back_m`: middle of the back wall.
void addTrap(SceneBuilder& builder, const Eigen::Vector2d& back_m, double yaw_rad, double width_m,
             double depth_m, double height_m);
constexpr double kWireRadius_m = 0.012;

/// Adds poles along a line, and wires at these heights between them, with a sag of 2 % of the span.
void addWireLine(SceneBuilder& builder, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                 double span_m, const std::vector<double>& heights_m, double sideways_m,
                 double radius_m = kWireRadius_m);

}  // namespace hagen::simulation
