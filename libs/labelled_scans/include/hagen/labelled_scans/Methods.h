// The methods that are scored: the filter with each of its settings, and what it is compared with.
#pragma once
#include <hagen/evaluation/Method.h>
#include <hagen/observations/Settings.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::labelled_scans {

/// The filter with these settings, as a row of the table.
struct SettingsRow {
    std::string name;
    observations::Settings settings;
    std::string sweep_key;  ///< of a sweep, else empty
    std::string sweep_value;
};

/// The row "hagen" where there are no sweeps, else a row for each value of each "KEY=VALUE,VALUE".
/// Throws SettingsError for a sweep that cannot be read, or settings that do not go together.
std::vector<SettingsRow> rowsOf(const observations::Settings& settings,
                                const std::vector<std::string>& sweeps);

/// All that is scored: the filter's rows, then, where asked for, what it is compared with.
struct MethodRows {
    std::vector<SettingsRow> filter;
    std::optional<observations::Settings> baselines;  ///< the baselines get its zone and its sensor
};

/// Settings with those of a recording merged in, where it has some.
observations::Settings settingsFor(observations::Settings settings,
                                   const std::filesystem::path& sensor_file);

/// The methods for a recording with these settings of its own. PCL's baselines are among them where
/// the program was built with PCL.
std::vector<evaluation::Method> methodsFor(const MethodRows& rows,
                                           const std::filesystem::path& sensor_file);

}  // namespace hagen::labelled_scans
