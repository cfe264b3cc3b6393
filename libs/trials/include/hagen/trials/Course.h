#pragma once
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scene.h>
#include <hagen/simulation/SceneDistance.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::trials {

/// A flight to be made: from a start to a goal through a scene.
struct Course {
    std::string scenario;
    std::uint64_t seed;
    simulation::Scene scene;
    simulation::SceneDistance distance;  ///< true clearances
    Eigen::Vector3d start_m, goal_m;
    double altitude_m;             ///< wanted above the ground
    Eigen::AlignedBox3d bounds_m;  ///< where the flight may lead
    double oracle_path_m;          ///< length of the shortest path found in the true scene
};

/// Names of all courses. Each leads 40 m along x:
///
///     forest-0.02  random trees of that many a square metre; forest-0.05, forest-0.10
///     orchard      rows 4 x 3 m at 10 to 30 degrees to the way, trees missing; flown at 2.5 m
///     gap          a wall 6 m high across, with a gap of 1.6 to 2.4 m anywhere in it
///     u-trap       walls 6 m high as a U, 9 to 11 m wide and 8 to 10 m deep, open to the start
///     terrain      slopes up to 15 degrees with trees and rocks
///     wires        lines of wires 24 mm thick across, one of each as high as one flies
///     movers       people, cars and drones at 1 to 3 m/s on circles across; flown at 1.5 m
///     street       parked cars, also in the middle, lamps, trees and walls; flown at 1.5 m
const std::vector<std::string>& courseNames();

/// The course of a scenario; a seed makes the same one everywhere. Scenes without a path for the
/// vehicle are rejected, and the next made from the same seed's stream.
/// Throws std::invalid_argument, naming the known ones, for any other name.
Course makeCourse(const std::string& scenario, std::uint64_t seed);

/// What a LiDAR on the vehicle suffers from in a trial: 2 cm of noise, 1 % of returns lost, spots
/// that miss thin wires the more often the farther they are. No dust; the vehicle is masked out.
simulation::LidarFaults trialFaults();

// What a course has to offer, on the shortest path past what stands.
constexpr double kCourseClearance_m = 0.65;
constexpr double kLowest_m = 1.0, kHighest_m = 4.5;  ///< above the ground

}  // namespace hagen::trials
