#pragma once
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/mapping/MappedScan.h>
#include <hagen/trials/Course.h>
#include <hagen/trials/LatencyProfile.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::trials {

enum class PoseError { None, Noise /* 5 cm, 0.5 deg */, Drift /* 1 % of the way */ };
enum class Outcome { Success, Collision, Timeout };

/// What is flown. Together with a seed (the course's) and a profile it determines a run.
struct TrialSetup {
    std::string model = "W-RoI";
    std::string guidance = "astar";
    std::string planner = "primitives";
    double speed_m_s = 4;
    PoseError pose_error = PoseError::None;
    double latency_scale = 1;            ///< 4: an embedded computer
    bool brakes_in_known_space = false;  ///< unknown space: optimistic, or brake only where known
    avoidance::VehicleLimits limits;
};

/// The stages of a setup's planning by their names in a profile: the filter where labels are
/// needed, update, guidance, planner.
std::vector<std::string> stagesOf(const TrialSetup& setup);

/// What came of a run. Does not depend on the machine.
struct TrialResult {
    Outcome outcome;
    double min_clearance_m;   ///< true, least of the flight
    double path_m, time_s;    ///< flown, until the end
    double first_reaction_m;  ///< true distance to the nearest obstacle ahead when it first left
                              ///< its course; NaN: never did
    double rms_jerk_m_s3;
    int scans, dropped_scans, emergency_stops;
    double latency_p50_ms, latency_p95_ms, latency_max_ms;  ///< sensor to command, by the profile
};

/// What this machine took for it; differs from time to time.
struct TrialMeasurement {
    std::map<std::string, std::vector<double>> stage_ms;  ///< CPU time by the profile's stage names
    double peak_model_bytes = 0;                          ///< heap, measured
    std::vector<std::pair<double, double>> model_bytes_by_path_m;  ///< path [m], heap [bytes]
};

/// All of one planning step, for replays; valid during the call.
struct TrialStep {
    double time_s;  ///< when the command is given
    avoidance::VehicleState true_state, believed_state;
    const mapping::MappedScan& scan;  ///< the scan planned on
    const avoidance::WorldModel& world;
    const avoidance::Carrot& carrot;
    const avoidance::Plan& plan;
    double true_clearance_m;
    double latency_ms;
};

struct TrialListener {
    std::function<void(const TrialStep&)> step;  ///< after each plan
    std::function<void(double time_s, const avoidance::VehicleState&)>
        moved;                                           ///< 50 Hz, true state
    std::function<void(const std::string& what)> event;  ///< "emergency stop", "collision"
    bool keeps_candidates = false;
};

/// Flies a course. Throws std::invalid_argument for unknown names.
TrialResult runTrial(const Course& course, const TrialSetup& setup, const LatencyProfile& profile,
                     TrialMeasurement* measurement = nullptr, const TrialListener& listener = {});

}  // namespace hagen::trials
