#pragma once
#include <hagen/avoidance/PathSearch.h>
#include <hagen/avoidance/Planner.h>
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

struct GuidanceTask {
    Eigen::Vector3d position_m;
    Eigen::Vector3d goal_m;
    double ground_m = 0, altitude_m = 2, lowest_m = 1.0, highest_m = 4.5;  ///< as in PlanningTask
    Eigen::AlignedBox3d bounds_m;                                          ///< limits
    VehicleLimits limits;
};

struct Carrot {
    Eigen::Vector3d at_m;                 ///< lookahead point for the planner
    std::vector<Eigen::Vector3d> path_m;  ///< for visualization; empty without a path
    double beyond_m = 0;                  ///< remaining path length from there to the goal
};

/// Chooses the next lookahead point. Keeps no state between calls.
class Guidance {
 public:
    virtual ~Guidance() = default;
    virtual Carrot carrot(const WorldModel& world, const GuidanceTask& task) const = 0;
};

/// "straight": towards the goal, level at the target altitude above the ground until near the goal.
/// "astar": 4 m ahead on an A* path over the same model (0.5 m cells), less if a bend would hide
/// that point; corners are cut where clearance permits. If the goal is blocked or out of bounds,
/// the path leads to the nearest free cell. Without a path, flies straight. makeGuidance() throws
/// std::invalid_argument for other names.
const std::vector<std::string>& guidanceNames();
std::unique_ptr<Guidance> makeGuidance(const std::string& name);

}  // namespace hagen::avoidance
