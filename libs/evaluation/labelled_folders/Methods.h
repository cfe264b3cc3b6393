// The scored methods: the filter with each of its settings, and the baselines.
#pragma once
#include <hagen/evaluation/Method.h>
#include <hagen/settings/CloudSensors.h>
#include <hagen/settings/Settings.h>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/labelled_folders/LabelRows.h"

namespace hagen::evaluation {

/// The filter with one set of settings: one row of the table.
struct SweepPoint {
    std::string name;
    Settings settings;
    std::string sweep_key;  ///< key of the sweep; empty without a sweep
    std::string sweep_value;
};

/// Returns one row "hagen" without sweeps, otherwise one row per value of each "KEY=VALUE,VALUE".
/// Throws SettingsError if a sweep cannot be parsed or settings are inconsistent.
std::vector<SweepPoint> rowsOf(const Settings& settings, const std::vector<std::string>& sweeps);

/// All scored methods: the filter's rows, then the baselines if requested, then precomputed labels.
struct MethodSet {
    std::vector<SweepPoint> filter;
    std::optional<Settings> baselines;  ///< zone and sensor of the baselines
    std::vector<LabelRow> labels = {};
    /// Adds the baselines "NAME, LIMIT=VALUE" for these values of each Baseline::limit.
    std::map<std::string, std::vector<std::string>> limits = {};
    bool is_upside_down = false;  ///< whether the sensor is upside down; see mirrored()
};

/// Adds a row per "NAME=DIR" of precomputed labels. Throws SettingsError like labelRowFrom().
void addLabelRows(const std::vector<std::string>& texts, MethodSet& rows);

/// Returns the filter's and baselines' methods for a recording, including PCL's if built with it.
/// Settings in `sensor_file`, if it exists, are merged into those of each row. If none name a
/// sensor, the recovered `beams` (ScanSource::beamsOf()) are used. The filter first masks the
/// airframe, which must be given in the scan's sensor frame: in rotated scans (tilted, upside
/// down), it is elsewhere. Throws SettingsError if settings and sensor are inconsistent.
std::vector<Method> methodsFor(const MethodSet& rows, const std::filesystem::path& sensor_file,
                               const SharedBeams& beams = nullptr);

}  // namespace hagen::evaluation
