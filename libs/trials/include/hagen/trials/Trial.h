#pragma once
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/mapping/MappedScan.h>
#include <hagen/trials/Course.h>
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/TrialMeasurement.h>
#include <hagen/trials/TrialResult.h>
#include <hagen/trials/TrialSetup.h>
#include <functional>
#include <string>

namespace hagen {

/// One planning step, for replays; valid during the call.
struct TrialStep {
    double time_s;  ///< when the command is given
    VehicleState true_state, believed_state;
    const MappedScan& scan;  ///< the scan planned on
    const WorldModel& world;
    const Carrot& carrot;
    const Plan& plan;
    double true_clearance_m;
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

}  // namespace hagen
