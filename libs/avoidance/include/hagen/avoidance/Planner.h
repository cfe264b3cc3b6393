#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <hagen/avoidance/WorldModel.h>
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// What a local planner is asked.
struct PlanningTask {
    VehicleState start;          ///< when a command given now will be followed (predicted)
    Eigen::Vector3d carrot_m;    ///< where guidance wants it to go, and how high
    double beyond_carrot_m = 0;  ///< way that is left from there; 0: it is the goal, to stop at
    double speed_m_s = 4;        ///< at most
    double ground_m = 0;         ///< height of the ground below, by the altimeter
    double altitude_m = 2;       ///< wanted, above the ground
    double lowest_m = 1.0, highest_m = 4.5;  ///< altitudes allowed
    VehicleLimits limits;
    double period_s = 0.1;  ///< the longest that a command may hold before the next can replace it
    bool brakes_in_known_space = false;  ///< a braking tail must end in space that was seen
    bool keeps_candidates = false;       ///< for pictures
};

/// A motion that was considered.
struct CandidateMotion {
    std::vector<Eigen::Vector3f> way_m;
    Eigen::Vector3d command_m_s;
    bool is_free;
};

struct Plan {
    Eigen::Vector3d command_m_s{0, 0, 0};  ///< velocity to fly
    bool is_emergency = false;             ///< nothing is free, or contact is near: it brakes
    std::vector<CandidateMotion> candidates;
};

class Planner {
 public:
    virtual ~Planner() = default;
    virtual Plan plan(const WorldModel& world, const PlanningTask& task) const = 0;
};

/// "primitives": motions of 36 azimuths x 5 elevations x 4 speeds, up, down and standing,
/// with a braking tail.
/// "3dvfh": polar histogram of 6 degree cells (3DVFH+).
/// Both stop where contact is near (mustStop). Throws std::invalid_argument for other names.
const std::vector<std::string>& plannerNames();
std::unique_ptr<Planner> makePlanner(const std::string& name);

/// The guard of both: whether braking must begin now, for going on with the present velocity for
/// another period would leave no room to stop.
bool mustStop(const WorldModel& world, const PlanningTask& task);

}  // namespace hagen::avoidance
