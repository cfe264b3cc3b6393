#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hagen::trials {

/// What a run cost on this machine; differs each time.
struct TrialMeasurement {
    std::map<std::string, std::vector<double>> stage_ms;  ///< CPU time by the profile's stage names
    double peak_model_bytes = 0;                          ///< heap, measured
    std::vector<std::pair<double, double>> model_bytes_by_path_m;  ///< path [m], heap [bytes]
};

}  // namespace hagen::trials
