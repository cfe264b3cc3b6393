#include "avoidance/flights/TrialScore.h"
#include <hagen/scan/Angle.h>
#include <cmath>
#include <limits>
#include "avoidance/planning/StraightWay.h"

namespace hagen::avoidance {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double straight_s(const Course& course, double speed_m_s) {
    return (course.goal_m - course.start_m).norm() / speed_m_s;
}

}  // namespace

TrialJudge::TrialJudge(const Course& course, double speed_m_s)
    : course_(course),
      longest_s_(longestFlight_s(course, speed_m_s)),
      longest_stall_s_(straight_s(course, speed_m_s) + 10),
      nearest_m_((course.goal_m - course.start_m).norm()) {}

double TrialJudge::longestFlight_s(const Course& course, double speed_m_s) {
    return 3 * straight_s(course, speed_m_s) + 20;
}

std::optional<Outcome> TrialJudge::judge(const Eigen::Vector3d& position_m, double clearance_m,
                                         double collision_m, double time_s) {
    if (clearance_m < collision_m) return Outcome::Collision;
    if ((course_.goal_m - position_m).norm() < kArrived_m) return Outcome::Success;
    if (isLate(position_m, time_s)) return Outcome::Timeout;
    return std::nullopt;
}

bool TrialJudge::isLate(const Eigen::Vector3d& position_m, double time_s) {
    const double away_m = (course_.goal_m - position_m).norm();
    if (away_m < nearest_m_ - 1) {
        nearest_m_ = away_m;
        nearest_since_s_ = time_s;
    }
    return time_s > longest_s_ || time_s - nearest_since_s_ > longest_stall_s_ ||
           course_.bounds_m.exteriorDistance(position_m) > kOutside_m;
}

double freeDistance_m(const Course& course, const Eigen::Vector3d& position_m,
                      double clearance_radius_m, double time_s) {
    const auto clearance_m = [&](const Eigen::Vector3f& at_m) {
        return course.distance.at(at_m, time_s);
    };
    return blockedAt_m(clearance_m, position_m, course.goal_m, clearance_radius_m).value_or(kNone);
}

bool leavesCourse(const Eigen::Vector3d& command_m_s, const Eigen::Vector3d& to_goal_m,
                  double speed_m_s) {
    const double speed = command_m_s.norm();
    if (speed < 0.7 * speed_m_s) return true;
    return command_m_s.dot(to_goal_m) < std::cos(radians(15)) * speed * to_goal_m.norm();
}

}  // namespace hagen::avoidance
