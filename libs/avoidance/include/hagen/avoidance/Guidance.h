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
    Eigen::AlignedBox3d bounds_m;  ///< where the flight may lead
    VehicleLimits limits;
};

struct Carrot {
    Eigen::Vector3d at_m;                 ///< what the planner shall head for
    std::vector<Eigen::Vector3d> path_m;  ///< for pictures; empty where there is none
    double beyond_m = 0;                  ///< way that is left from there to the goal
};

/// Where to head for: no memory from call to call.
class Guidance {
 public:
    virtual ~Guidance() = default;
    virtual Carrot carrot(const WorldModel& world, const GuidanceTask& task) const = 0;
};

/// "straight": at the goal, level at the wanted altitude above the ground until it is near.
/// "astar": 4 m ahead on A*'s path over the same model (0.5 m cells), less where a bend would hide
/// it, corners cut where there is room; to the free cell nearest to a goal that is blocked or out
/// of the bounds; straight where there is no path. Throws std::invalid_argument for other names.
const std::vector<std::string>& guidanceNames();
std::unique_ptr<Guidance> makeGuidance(const std::string& name);

}  // namespace hagen::avoidance
