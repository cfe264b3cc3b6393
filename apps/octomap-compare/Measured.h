#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen {

/// What runs of a model cost on the machine that flew them, a value a run.
struct MeasuredRuns {
    std::vector<double> peak_model_bytes;
    std::map<std::string, std::vector<double>> p50_ms;  ///< CPU time by stage
};

/// measured.csv of a campaign, by model. Columns are found by name; fields may be empty. Throws
/// std::runtime_error, naming file and line, for a line without all columns, or no number.
std::map<std::string, MeasuredRuns> readMeasured(const std::filesystem::path& file);

}  // namespace hagen
