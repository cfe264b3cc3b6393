#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Trial.h>
#include <optional>

namespace hagen::avoidance {

/// Decides when a flight ends and how, from true positions, at every control step. T is the time
/// of flight along the straight line from start to goal at full speed:
///
///     collision  the true clearance is below limits.collision_m
///     success    the vehicle is within kArrived_m of the goal
///     timeout    the flight took longer than 3 T + 20 s,
///                or made less than 1 m of progress towards the goal in T + 10 s,
///                or left the course's bounds by more than kOutside_m
class TrialJudge {
 public:
    static constexpr double kArrived_m = 1.5, kOutside_m = 1;

    TrialJudge(const Course& course, double speed_m_s);

    /// Longer flights time out, even if the vehicle still approaches the goal. [s]
    static double longestFlight_s(const Course& course, double speed_m_s);

    /// The outcome, once the flight has ended.
    std::optional<Outcome> judge(const Eigen::Vector3d& position_m, double clearance_m,
                                 double collision_m, double time_s);

 private:
    bool isLate(const Eigen::Vector3d& position_m, double time_s);

    const Course& course_;
    double longest_s_, longest_stall_s_;
    double nearest_m_, nearest_since_s_ = 0;
};

/// Distance that a vehicle can fly straight towards the goal before the true clearance falls below
/// `clearance_radius_m`. NaN if the whole line is free. [m]
double freeDistance_m(const Course& course, const Eigen::Vector3d& position_m,
                      double clearance_radius_m, double time_s);

/// Whether a command leaves the straight line to the goal: it points more than 15 degrees away from
/// the goal, or is slower than 0.7 of `speed_m_s`.
bool leavesCourse(const Eigen::Vector3d& command_m_s, const Eigen::Vector3d& to_goal_m,
                  double speed_m_s);

}  // namespace hagen::avoidance
