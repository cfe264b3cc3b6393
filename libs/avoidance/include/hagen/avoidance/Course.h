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

/// Names of all scenarios. Each leads 40 m along x:
///
///     forest-0.02  random trees, 0.02 per square metre; likewise forest-0.05, forest-0.10
///     orchard      rows 4 x 3 m at 10 to 30 degrees to the path, some trees missing;
///                  flown at 2.5 m
///     gap          a wall 6 m high across the path, with a gap of 1.6 to 2.4 m anywhere in it
///     u-trap       walls 6 m high as a U, 9 to 11 m wide and 8 to 10 m deep, open to the start
///     terrain      slopes up to 15 degrees with trees and rocks
///     wires        wires 24 mm thick across the path, one of each line at flight altitude
///     wires-thin   the same with wires 10 mm thick
///     movers       people, cars and drones that circle across the path at 1 to 3 m/s; flown at
///                  1.5 m
///     street       parked cars, even in the middle, lamps, trees and walls; flown at 1.5 m
const std::vector<std::string>& courseNames();

/// The course of a scenario. A seed produces the same course on every machine. Scenes without a
/// path for the vehicle are rejected and replaced from the seed's next stream. Throws
/// std::invalid_argument, listing the known names, for an unknown name.
Course makeCourse(const std::string& scenario, std::uint64_t seed);

// Every course has a path past its static obstacles with this clearance, between these heights.
constexpr double kCourseClearance_m = 0.65;
constexpr double kMinHeight_m = 1.0, kMaxHeight_m = 4.5;  ///< above the ground

}  // namespace hagen::avoidance
