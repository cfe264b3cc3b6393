#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <hagen/trials/PoseError.h>
#include <string>
#include <vector>

namespace hagen::trials {

/// What flies a course, and how. With a course and a latency profile it determines a run.
struct TrialSetup {
    std::string model = "W-RoI";
    std::string guidance = "astar";
    std::string planner = "primitives";
    double speed_m_s = 4;
    PoseError pose_error = PoseError::None;
    double latency_scale = 1;            ///< 4: an embedded computer
    bool brakes_in_known_space = false;  ///< stay able to brake within space that was seen
    avoidance::VehicleLimits limits;
};

/// The stages of one planning step by their names in a latency profile: the filter if the model
/// needs labels, update, guidance, planner.
std::vector<std::string> stagesOf(const TrialSetup& setup);

}  // namespace hagen::trials
