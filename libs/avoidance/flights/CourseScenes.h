#pragma once
#include <hagen/simulation/Scene.h>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// A kind of course: its obstacles and flight altitude.
struct CourseKind {
    std::string name;
    double altitude_m;  ///< target height above the ground
    simulation::Scene (*make)(simulation::Random random);
};

/// In the order of courseNames().
const std::vector<CourseKind>& courseKinds();

// Seen from above, every course has the same start and goal. The obstacle field is larger than the
// bounds of the flight.
inline const Eigen::Vector2d kCourseStart_m{0, 0}, kCourseGoal_m{40, 0};
inline const Eigen::AlignedBox2d kCourseField_m{Eigen::Vector2d(-8, -17), Eigen::Vector2d(48, 17)};
constexpr double kFreeAtEnds_m = 2.0;  ///< radius free of obstacles at start and goal

}  // namespace hagen::avoidance
