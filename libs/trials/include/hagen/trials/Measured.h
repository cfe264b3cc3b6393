#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::trials {

/// What runs of a model cost on the machine that flew them, one value per run with whole scans.
struct MeasuredRuns {
    std::vector<double> peak_model_bytes;
    std::map<std::string, std::vector<double>> p50_ms;  ///< CPU time by stage
};

using MeasuredByModel = std::map<std::string, MeasuredRuns>;

/// Adds a row, unless it is of a run with sectors. Columns are found by the header's names; fields
/// may be empty. Throws std::runtime_error for a row without all columns, or no number.
void addMeasured(const std::string& header, const std::string& row, MeasuredByModel& all);

/// measured.csv of a campaign. Throws as addMeasured, naming file and line.
MeasuredByModel readMeasured(const std::filesystem::path& file);

}  // namespace hagen::trials
