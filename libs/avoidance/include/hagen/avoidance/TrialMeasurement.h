#pragma once
#include <map>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// What a run cost on this machine; differs each time.
struct TrialMeasurement {
    std::map<std::string, std::vector<double>> stage_ms;  ///< CPU time by the profile's stage names
};

}  // namespace hagen::avoidance
