#pragma once
#include <hagen/trials/Course.h>
#include <hagen/trials/Trial.h>
#include <optional>

namespace hagen::trials {

/// When a flight ends, and how: judged by true positions, every control step.
///
///     collision  the true clearance is less than limits.collision_m
///     success    the goal is within kArrived_m
///     timeout    the flight took longer than three times the straight way at full speed and 20 s;
///     or it
///                came no metre nearer to the goal for the straight way at full speed and 10 s; or
///                it left the course's bounds by more than kOutside_m
class TrialJudge {
 public:
    static constexpr double kArrived_m = 1.5, kOutside_m = 1;

    TrialJudge(const Course& course, double speed_m_s);

    /// A flight that takes longer is a timeout, even one that comes nearer all the time. [s]
    static double longestFlight_s(const Course& course, double speed_m_s);

    /// The outcome, once there is one.
    std::optional<Outcome> judge(const Eigen::Vector3d& position_m, double clearance_m,
                                 double collision_m, double time_s);

 private:
    bool isLate(const Eigen::Vector3d& position_m, double time_s);

    const Course& course_;
    double longest_s_, longest_stall_s_;
    double nearest_m_, nearest_since_s_ = 0;
};

/// How far straight on towards the goal a vehicle of this room has its way: to where the true
/// clearance first falls below `room_m`. NaN where the whole way is free. [m]
double freeWay_m(const Course& course, const Eigen::Vector3d& position_m, double room_m,
                 double time_s);

/// Whether a command leaves the straight course: it points more than 15 degrees off the goal, or
/// is slower than 0.7 of `speed_m_s`.
bool leavesCourse(const Eigen::Vector3d& command_m_s, const Eigen::Vector3d& to_goal_m,
                  double speed_m_s);

}  // namespace hagen::trials
