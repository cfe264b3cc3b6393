#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/FlightConditions.h>
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/LatencyProfile.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/avoidance/Vehicle.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/mrpt/MappedScan.h>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// The setup of a run. With a course and a latency profile, it determines the result.
struct TrialSetup {
    std::string model = "W-RoI";
    std::string guidance = "astar";
    std::string planner = "primitives";
    double speed_m_s = 4;
    PoseError pose_error = PoseError::None;
    double latency_scale = 1;            ///< 4 represents an embedded computer
    bool brakes_in_known_space = false;  ///< braking must end in observed space
    Air air = Air::Dusty;
    ModelDistance distance = ModelDistance::Unbiased;
    Updates updates = Updates::Scans;
    VehicleLimits limits;
    /// If set, creates the world model; `model` then only selects latencies. For experiments;
    /// campaigns use named models.
    std::function<std::unique_ptr<WorldModel>(const WorldModelSetting&)> make_world;
};

/// The names of a planning step's stages in a latency profile: the filter if the model needs
/// labels, update, guidance, planner.
std::vector<std::string> stagesOf(const TrialSetup& setup);

/// The outcome of a run. Does not depend on the machine.
struct TrialResult {
    Outcome outcome = Outcome::Timeout;
    double min_clearance_m = std::numeric_limits<double>::infinity();  ///< true minimum
    double path_m = 0, time_s = 0;  ///< length and duration of the flight
    /// True free distance ahead when a command first left the straight line; NaN if none did.
    double first_reaction_m = std::numeric_limits<double>::quiet_NaN();
    double rms_jerk_m_s3 = 0;
    int scans = 0, dropped_scans = 0, emergency_stops = 0;
    /// Sensor-to-command latencies drawn from the profile.
    double latency_p50_ms = 0, latency_p95_ms = 0, latency_max_ms = 0;
};

/// Run times of the stages on this machine; they differ between runs.
struct TrialMeasurement {
    std::map<std::string, std::vector<double>> stage_ms;  ///< CPU time by the profile's stage names
};

/// One planning step, for replays; valid during the call.
struct TrialStep {
    double time_s;                         ///< when the command is issued
    const observations::MappedScan& scan;  ///< the scan used for planning
    const WorldModel& world;
    const Carrot& carrot;
    const Plan& plan;
    double latency_ms;
};

struct TrialListener {
    std::function<void(const TrialStep&)> step;                     ///< after each plan
    std::function<void(double time_s, const VehicleState&)> moved;  ///< 50 Hz, true state
    std::function<void(const std::string& what)> event;  ///< "emergency stop", "collision"
    bool keeps_candidates = false;
};

/// Flies a course. Throws std::invalid_argument for unknown names.
TrialResult runTrial(const Course& course, const TrialSetup& setup, const LatencyProfile& profile,
                     TrialMeasurement* measurement = nullptr, const TrialListener& listener = {});

}  // namespace hagen::avoidance
