#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "avoidance/flights/RunTable.h"

namespace hagen::avoidance {

/// Criteria for selecting a run. Empty names and 0 match all runs.
struct RunWanted {
    std::uint64_t seed = 0;
    std::string scenario, model, guidance, planner, pose_error;
    std::string unknown;  ///< "optimistic", or "brake-known"
    std::string air, distance, updates;
    double speed_m_s = 0, latency_scale = 0;
};

/// The matching run. Throws std::invalid_argument listing the candidates unless one run matches.
Run chooseRun(const std::vector<Run>& runs, const RunWanted& wanted);

/// The flags that select a run `among` others with its seed, for a shell:
/// "--scenario gap --model W-RoI --guidance astar --speed 4 --latency-scale 4   # success".
std::string choiceOf(const Run& run, const std::vector<Run>& among);

/// A unique name of a run for files: "gap-7-W-RoI-astar-4mps", followed by conditions that differ
/// from the defaults: "-3dvfh-noise-latency4-brake-known-clear-as-stored".
std::string fileNameOf(const Run& run);

}  // namespace hagen::avoidance
