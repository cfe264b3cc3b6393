#pragma once
#include <hagen/simulation/Scene.h>
#include <hagen/simulation/SceneDistance.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// A start, a goal and the scene between them.
struct Course {
    std::string scenario;
    std::uint64_t seed;
    simulation::Scene scene;
    simulation::SceneDistance distance;  ///< true clearances
    Eigen::Vector3d start_m, goal_m;
    double altitude_m;             ///< target height above the ground
    Eigen::AlignedBox3d bounds_m;  ///< limits of the flight
    double oracle_path_m;          ///< length of the shortest path found in the true scene
};

/// Names of all scenarios (docs/octomap-compare.md). Each leads 40 m along x.
const std::vector<std::string>& courseNames();

/// The course of a scenario. A seed produces the same course on every machine. Scenes without a
/// path for the vehicle are rejected and replaced from the seed's next stream. Throws
/// std::invalid_argument, listing the known names, for an unknown name.
Course makeCourse(const std::string& scenario, std::uint64_t seed);

// Every course has a path past its static obstacles with this clearance, between these heights.
constexpr double kCourseClearance_m = 0.65;
constexpr double kMinHeight_m = 1.0, kMaxHeight_m = 4.5;  ///< above the ground

}  // namespace hagen::avoidance
