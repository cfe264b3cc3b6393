// The candidate values and the data to score them on: config/selection.yaml.
#pragma once
#include <hagen/settings/Settings.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Descent.h"

namespace hagen::selection {

struct Plan {
    int max_rounds = 3;                  ///< maximum rounds of coordinate descent
    std::vector<std::string> hard_sets;  ///< see `--degrade`
    std::vector<Setting> settings;
    /// Values in which the plain start differs from the presets.
    std::map<std::string, std::string> plain;
};

/// Reads
///
///     rounds: 3
///     hard_sets: [dropout=20]
///     settings:
///       ground_tolerance_m: [0.14, 0.17, 0.20]
///     plain: {ground_tolerance_m: 0.20}
///
/// where `settings` is required, and `plain` has one of the listed values for some settings. Throws
/// std::runtime_error naming file, line and entry for invalid files, unknown or repeated keys,
/// unknown settings, values or degradations.
Plan readPlan(const std::filesystem::path& file);

/// The current values of the settings, added to the candidates if missing. Throws
/// std::runtime_error naming the setting if the presets (files in `config`) differ: it depends on
/// the sensor and cannot be chosen for all sensors.
Choice presentChoice(const std::vector<std::filesystem::path>& presets, Plan& plan);

/// The plain start: the current choice with the values of Plan::plain.
Choice plainChoice(const Plan& plan, Choice present);

/// Sets the chosen values.
void apply(const std::vector<Setting>& settings, const Choice& choice, Settings& target);

}  // namespace hagen::selection
