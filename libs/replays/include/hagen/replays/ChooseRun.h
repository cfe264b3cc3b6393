#pragma once
#include <hagen/trials/RunTable.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::replays {

/// Criteria for selecting a run. Empty names and 0: any.
struct RunWanted {
    std::uint64_t seed = 0;
    std::string scenario, model, guidance, planner, pose_error;
    std::string unknown;  ///< "optimistic", or "brake-known"
    std::string air, distance, updates;
    double speed_m_s = 0, latency_scale = 0;
};

/// The run that matches. Throws std::invalid_argument and lists the candidates if none or several
/// match.
trials::Run chooseRun(const std::vector<trials::Run>& runs, const RunWanted& wanted);

/// The flags that select a run `among` others of its seed, for a shell:
/// "--scenario gap --model W-RoI --guidance astar --speed 4 --latency-scale 4   # success".
std::string choiceOf(const trials::Run& run, const std::vector<trials::Run>& among);

/// A unique name of a run for files: "gap-7-W-RoI-astar-4mps", followed by conditions that differ
/// from the defaults: "-3dvfh-noise-latency4-brake-known-clear-as-stored".
std::string fileNameOf(const trials::Run& run);

}  // namespace hagen::replays
