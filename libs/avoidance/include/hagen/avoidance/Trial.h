#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/LatencyProfile.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/avoidance/TrialMeasurement.h>
#include <hagen/avoidance/TrialResult.h>
#include <hagen/avoidance/TrialSetup.h>
#include <hagen/mrpt/MappedScan.h>
#include <functional>
#include <string>

namespace hagen::avoidance {

/// One planning step, for replays; valid during the call.
struct TrialStep {
    double time_s;  ///< when the command is given
    avoidance::VehicleState true_state, believed_state;
    const observations::MappedScan& scan;  ///< the scan planned on
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

}  // namespace hagen::avoidance
