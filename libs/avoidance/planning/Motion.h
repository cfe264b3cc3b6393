#pragma once
#include <hagen/avoidance/Planner.h>
#include <optional>
#include <vector>

// Shared by the planners: the path of a command and its collision check.
namespace hagen::avoidance {

constexpr double kLookAhead_s = 1.2;

/// The path from a state, one point per control step: the command is held for `hold_s`, then the
/// vehicle brakes to a stop.
void rollOut(const VehicleState& start, const Eigen::Vector3d& command_m_s, double hold_s,
             const VehicleLimits& limits, std::vector<Eigen::Vector3f>& path_m);

/// The minimum clearance along a path of rollOut() that starts `start_after_s` after the model's
/// last scan, or nullopt if it falls below `clearance_radius_m`. A path that starts closer to an
/// obstacle must not approach it.
std::optional<float> freeClearance(const WorldModel& world,
                                   const std::vector<Eigen::Vector3f>& path_m, double start_after_s,
                                   double clearance_radius_m);

/// Like freeClearance(), but without a required clearance.
float minClearance_m(const WorldModel& world, const std::vector<Eigen::Vector3f>& path_m,
                     double start_after_s);

/// The paths of a command: held before braking, and interrupted after one period.
struct CommandPaths {
    std::vector<Eigen::Vector3f> held_m, broken_off_m;
};

/// Checks two paths: the command is held for `hold_s` or for one period only, and the vehicle then
/// brakes. The short path ensures that the vehicle can still brake after one period. If the
/// vehicle is too close to an obstacle, the command must lead away. Returns the minimum clearance
/// of both paths, or nullopt if either is not free. `paths` is working memory reused by the
/// planner.
std::optional<float> checkCommand(const WorldModel& world, const PlanningTask& task,
                                  const Eigen::Vector3d& command_m_s, double hold_s,
                                  CommandPaths& paths);

/// The maximum speed, reduced so that the vehicle can stop at the goal.
double speedTowardsGoal(const PlanningTask& task);

/// Distance of a height from the altitude limits [m]; 0 within them.
double outOfAltitudes(double height_m, const PlanningTask& task);

/// Costs at a command's end: per metre off the target height, and per metre outside the limits.
constexpr double kHeightCost_per_m = 0.3, kOutOfAltitudesCost_per_m = 3;

}  // namespace hagen::avoidance
