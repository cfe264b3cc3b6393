#pragma once
#include <hagen/simulation/Scene.h>
#include <hagen/simulation/SceneDistance.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen {

/// A flight to be made: from a start to a goal through a scene.
struct Course {
    std::string scenario;
    std::uint64_t seed;
    Scene scene;
    SceneDistance distance;  ///< true clearances
    Eigen::Vector3d start_m, goal_m;
    double altitude_m;             ///< wanted above the ground
    Eigen::AlignedBox3d bounds_m;  ///< where the flight may lead
    double oracle_path_m;          ///< length of the shortest path found in the true scene
};

/// forest-0.02 forest-0.05 forest-0.10 orchard gap u-trap terrain wires movers street
const std::vector<std::string>& courseNames();

/// The course of a scenario; a seed makes the same one everywhere. Scenes without a path for the
/// vehicle are rejected, and the next made from the same seed's stream.
/// Throws std::invalid_argument, naming the known ones, for any other name.
Course makeCourse(const std::string& scenario, std::uint64_t seed);

}  // namespace hagen
