#pragma once
#include <hagen/avoidance/Planner.h>
#include <optional>
#include <vector>

// What planners share: where a command leads, and whether the way there is free.
namespace hagen::avoidance {

constexpr double kLookAhead_s = 1.2;

/// The way from a state, a point each control step: a command for so long, then braking until the
/// vehicle stands.
void rollOut(const VehicleState& start, const Eigen::Vector3d& command_m_s, double hold_s,
             const VehicleLimits& limits, std::vector<Eigen::Vector3f>& way_m);

/// The least clearance seen on a way; none where it is less than `room_m` somewhere. A way that
/// begins nearer than that must not come nearer still.
std::optional<float> freeClearance(const WorldModel& world,
                                   const std::vector<Eigen::Vector3f>& way_m, double room_m);

/// The ways of a command: held, then braking; and broken off after a period.
struct CommandWays {
    std::vector<Eigen::Vector3f> held_m, broken_off_m;
};

/// Whether a command can be flown: held for `hold_s` and followed by braking, and just as well
/// broken off after a period, so that braking at once will be possible then. From too near an
/// obstacle it must lead away. The least clearance of both. The ways are left in `ways`, which a
/// planner reuses from command to command.
std::optional<float> checkCommand(const WorldModel& world, const PlanningTask& task,
                                  const Eigen::Vector3d& command_m_s, double hold_s,
                                  CommandWays& ways);

/// At most the speed wanted, and slow enough to stop at the goal.
double speedTowardsGoal(const PlanningTask& task);

/// How far a height is out of the altitudes allowed [m]; 0 within.
double outOfAltitudes(double height_m, const PlanningTask& task);

}  // namespace hagen::avoidance
