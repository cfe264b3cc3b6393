#pragma once
#include <hagen/trials/RunTable.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::replays {

/// What is known of the run that is wanted. Empty names and 0: any.
struct RunWanted {
    std::uint64_t seed = 0;
    std::string scenario, model, guidance, planner, pose_error;
    std::string unknown;  ///< "optimistic", or "brake-known"
    double speed_m_s = 0, latency_scale = 0;
};

/// The only run that is wanted. Throws std::invalid_argument where there is none, or several: then
/// the message lists what there is to choose from.
trials::Run chooseRun(const std::vector<trials::Run>& runs, const RunWanted& wanted);

/// A run, by the flags that tell it from those of its seed `among` which it is, as a shell takes
/// them: "--scenario gap --model W-RoI --guidance astar --speed 4 --latency-scale 4   # success".
std::string choiceOf(const trials::Run& run, const std::vector<trials::Run>& among);

/// A run as a file is called, different of each: "gap-7-W-RoI-astar-4mps"; conditions that are not
/// the usual ones follow: "-3dvfh-noise-latency4-brake-known".
std::string fileNameOf(const trials::Run& run);

}  // namespace hagen::replays
