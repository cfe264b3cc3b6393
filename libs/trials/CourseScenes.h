#pragma once
#include <hagen/simulation/Scene.h>
#include <string>
#include <vector>

namespace hagen::trials {

/// A sort of course: what stands between start and goal, and how high one flies there.
struct CourseSort {
    std::string name;
    double altitude_m;  ///< wanted above the ground
    simulation::Scene (*make)(simulation::Random random);
};

/// In the order of courseNames().
const std::vector<CourseSort>& courseSorts();

// Seen from above, all courses lead from here to there through a field of obstacles that reaches
// beyond where one may fly.
inline const Eigen::Vector2d kCourseStart_m{0, 0}, kCourseGoal_m{40, 0};
inline const Eigen::AlignedBox2d kCourseField_m{Eigen::Vector2d(-8, -17), Eigen::Vector2d(48, 17)};
constexpr double kFreeAtEnds_m = 2.0;  ///< about start and goal

}  // namespace hagen::trials
