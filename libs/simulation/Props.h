#pragma once
#include "simulation/SceneBuilder.h"

namespace hagen::simulation {

// Shapes with the origin on the ground.
Shape makeRod(double height_m, double radius_m);  ///< a pole
Shape makeCar(Random& random);                    ///< x forward
Shape makeHouse(double length_m, double width_m, double wall_m, Random& random);
Shape makeRock(Random& random);  ///< about 1 m across
Shape makePerson();
Shape makeDrone();

// Objects that follow the ground, added to a scene.

/// Adds a wall along a line, in pieces that follow the ground.
void addWall(SceneBuilder& builder, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
             double height_m, double thickness_m);
/// Adds three walls, open in the direction `yaw_rad`, from the middle of the back wall.
void addTrap(SceneBuilder& builder, const Eigen::Vector2d& back_m, double yaw_rad, double width_m,
             double depth_m, double height_m);
constexpr double kWireRadius_m = 0.012;

/// Adds poles along a line and wires between them at these heights, with a sag of 2 % of the span.
void addWireLine(SceneBuilder& builder, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                 double span_m, const std::vector<double>& heights_m, double sideways_m,
                 double radius_m = kWireRadius_m);

}  // namespace hagen::simulation
