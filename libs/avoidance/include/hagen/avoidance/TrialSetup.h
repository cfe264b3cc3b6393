#pragma once
#include <hagen/avoidance/Air.h>
#include <hagen/avoidance/Distance.h>
#include <hagen/avoidance/PoseError.h>
#include <hagen/avoidance/Updates.h>
#include <hagen/avoidance/Vehicle.h>
#include <hagen/avoidance/WorldModel.h>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// What flies a course, and how. With a course and a latency profile it determines a run.
struct TrialSetup {
    std::string model = "W-RoI";
    std::string guidance = "astar";
    std::string planner = "primitives";
    double speed_m_s = 4;
    PoseError pose_error = PoseError::None;
    double latency_scale = 1;            ///< 4: an embedded computer
    bool brakes_in_known_space = false;  ///< stay able to brake within space that was seen
    Air air = Air::Dusty;
    ModelDistance distance = ModelDistance::Unbiased;
    Updates updates = Updates::Scans;
    avoidance::VehicleLimits limits;
    /// If set, makes the world model instead of `model`, whose latencies then apply. For
    /// experiments; campaigns fly named models.
    std::function<std::unique_ptr<avoidance::WorldModel>(const avoidance::WorldModelSetting&)>
        make_world;
};

/// The stages of one planning step by their names in a latency profile: the filter if the model
/// needs labels, update, guidance, planner.
std::vector<std::string> stagesOf(const TrialSetup& setup);

}  // namespace hagen::avoidance
