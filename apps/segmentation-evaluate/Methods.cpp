#include "Methods.h"

#include <hagen/evaluation/Baselines.h>
#include <hagen/segmentation/HagenFilter.h>
#ifdef HAGEN_HAS_PCL_BASELINE
#include <hagen/pcl_baseline/BaselinePclEuclidean.h>
#endif
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

namespace hagen {
namespace {

/// How the sensor was tilted, where its pose in the map is known: yaw, pitch, roll about z, y, x.
std::optional<Attitude> attitudeOf(const ScanInput& input) {
    if (!input.map_from_sensor) return std::nullopt;
    const Eigen::Matrix3f& turn = *input.map_from_sensor;
    return Attitude{std::atan2(turn(2, 1), turn(2, 2)),
                    std::asin(std::clamp(-turn(2, 0), -1.0f, 1.0f))};
}

Method filterMethod(const std::string& name, const Settings& settings) {
    const auto filter =
        std::make_shared<HagenFilter>(filterFor(settings.sensorModel(), settings.options));
    return {name, [filter](const ScanInput& input) {
                return filter->segment(input.scan, attitudeOf(input)).returns.label;
            }};
}

std::vector<Baseline> allBaselines(float zone_m) {
    std::vector<Baseline> all = baselines(zone_m);
#ifdef HAGEN_HAS_PCL_BASELINE
    for (const Baseline& baseline : pclBaselines(zone_m)) all.push_back(baseline);
#endif
    return all;
}

/// "5,7.5" as two texts; an empty one stays, and is refused as a value later.
std::vector<std::string> valuesOf(const std::string& text) {
    std::vector<std::string> values;
    std::istringstream stream(text);
    for (std::string value; std::getline(stream, value, ',');) values.push_back(value);
    return values;
}

}  // namespace

std::vector<SettingsRow> rowsOf(const Settings& settings, const std::vector<std::string>& sweeps) {
    std::vector<SettingsRow> rows;
    if (sweeps.empty()) rows.push_back({"hagen", settings, "", ""});
    for (const std::string& sweep : sweeps) {
        const std::size_t equals = sweep.find('=');
        if (equals == std::string::npos || equals + 1 == sweep.size()) {
            throw SettingsError("--sweep: expected KEY=VALUE,VALUE,..., not '" + sweep + "'");
        }
        const std::string key = sweep.substr(0, equals);
        for (const std::string& value : valuesOf(sweep.substr(equals + 1))) {
            SettingsRow row{key + "=" + value, settings, key, value};
            setOption(key, value, row.settings);
            rows.push_back(row);
        }
    }
    for (const SettingsRow& row : rows) {
        if (row.settings.options.window_scans > 1) {
            throw SettingsError("window_scans is above 1; scans are scored one by one here");
        }
    }
    return rows;
}

Settings settingsFor(Settings settings, const std::filesystem::path& sensor_file) {
    if (std::filesystem::exists(sensor_file)) mergeSettings(sensor_file, settings);
    return settings;
}

std::vector<Method> methodsFor(const MethodRows& rows, const std::filesystem::path& sensor_file) {
    std::vector<Method> methods;
    for (const SettingsRow& row : rows.filter) {
        methods.push_back(filterMethod(row.name, settingsFor(row.settings, sensor_file)));
    }
    if (!rows.baselines) return methods;
    const Settings settings = settingsFor(*rows.baselines, sensor_file);
    const SensorModel sensor = settings.sensorModel();
    for (const Baseline& baseline : allBaselines(settings.options.zone_m)) {
        methods.push_back({baseline.name, [baseline, sensor](const ScanInput& input) {
                               return baseline.segment(input.scan, sensor);
                           }});
    }
    return methods;
}

}  // namespace hagen
