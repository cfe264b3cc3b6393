#pragma once
#include <hagen/trials/Condition.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hagen::trials {

/// What runs cost on the machine that flew them, one value per run.
struct MeasuredRuns {
    std::vector<double> peak_model_bytes;
    std::map<std::string, std::vector<double>> p50_ms;  ///< CPU time by stage
};

/// Boxes and windows grow with the speed: runs under different conditions cost differently.
using MeasuredByContender = std::map<std::pair<Condition, Contender>, MeasuredRuns>;

/// Adds a row. Columns are found by the header's names; older tables lack some, and measured fields
/// may be empty. Throws std::runtime_error for a row without all columns, no number or an unknown
/// word.
void addMeasured(const std::string& header, const std::string& row, MeasuredByContender& all);

/// measured.csv of a campaign. Throws as addMeasured, naming file and line.
MeasuredByContender readMeasured(const std::filesystem::path& file);

}  // namespace hagen::trials
