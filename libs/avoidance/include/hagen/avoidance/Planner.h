#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <hagen/avoidance/WorldModel.h>
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// The input of a local planner.
struct PlanningTask {
    VehicleState start;          ///< predicted for the time when a command takes effect
    double start_after_s = 0;    ///< time since the model's last scan
    Eigen::Vector3d carrot_m;    ///< lookahead point of the guidance
    double beyond_carrot_m = 0;  ///< remaining path length from there; 0: the carrot is the goal
    double speed_m_s = 4;        ///< maximum speed
    double ground_m = 0;         ///< height of the ground below, from the altimeter
    double altitude_m = 2;       ///< target height above the ground
    double lowest_m = 1.0, highest_m = 4.5;  ///< altitude limits above the ground
    VehicleLimits limits;
    double period_s = 0.1;               ///< maximum time until the next command
    bool brakes_in_known_space = false;  ///< braking must end in observed space
    bool keeps_candidates = false;       ///< for visualization
};

/// A candidate motion of a planner.
struct CandidateMotion {
    std::vector<Eigen::Vector3f> path_m;
    Eigen::Vector3d command_m_s;
    bool is_free;
};

struct Plan {
    Eigen::Vector3d command_m_s{0, 0, 0};  ///< velocity to fly
    bool is_emergency = false;             ///< no motion is free, or contact is imminent
    std::vector<CandidateMotion> candidates;
};

class Planner {
 public:
    virtual ~Planner() = default;
    virtual Plan plan(const WorldModel& world, const PlanningTask& task) const = 0;
};

/// "primitives": motion primitives of 36 azimuths x 5 elevations x 4 speeds, up, down and hovering,
/// each followed by braking.
/// "3dvfh": polar histogram with 6 degree cells (3DVFH+).
/// Both brake if no motion is free or contact is imminent (mustStop); near moving obstacles, where
/// braking is not safe, "primitives" evades instead. makePlanner() throws std::invalid_argument for
/// other names.
const std::vector<std::string>& plannerNames();
std::unique_ptr<Planner> makePlanner(const std::string& name);

/// Whether braking must begin now, because another period at the current velocity would leave too
/// little distance to stop.
bool mustStop(const WorldModel& world, const PlanningTask& task);

}  // namespace hagen::avoidance
