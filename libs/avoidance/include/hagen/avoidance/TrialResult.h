#pragma once
#include <string>

namespace hagen::avoidance {

enum class Outcome { Success, Collision, Timeout };

/// "success", "collision", "timeout".
std::string nameOf(Outcome outcome);

/// The outcome of a run. Does not depend on the machine.
struct TrialResult {
    Outcome outcome;
    double min_clearance_m;   ///< true, least of the flight
    double path_m, time_s;    ///< flown, until the end
    double first_reaction_m;  ///< true free way ahead when a command first left the straight line;
                              ///< NaN: never
    double rms_jerk_m_s3;
    int scans, dropped_scans, emergency_stops;
    double latency_p50_ms, latency_p95_ms, latency_max_ms;  ///< sensor to command, by the profile
};

}  // namespace hagen::avoidance
