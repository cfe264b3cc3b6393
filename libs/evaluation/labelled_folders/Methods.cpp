#include "evaluation/labelled_folders/Methods.h"

#include <hagen/evaluation/Baselines.h>
#include <hagen/filter/HagenFilter.h>
#include "base/Text.h"
#include "evaluation/Degradation.h"
#ifdef HAGEN_HAS_PCL_BASELINE
#include <hagen/pcl_baseline/BaselinePclEuclidean.h>
#endif
#include <algorithm>
#include <cmath>

namespace hagen::evaluation {
namespace {

/// Returns the attitude of a sensor with a known map pose: yaw, pitch, roll about z, y, x.
std::optional<Attitude> attitudeOf(const ScanInput& input) {
    if (!input.map_from_sensor) return std::nullopt;
    const Eigen::Matrix3f& turn = *input.map_from_sensor;
    return Attitude{std::atan2(turn(2, 1), turn(2, 2)),
                    std::asin(std::clamp(-turn(2, 0), -1.0f, 1.0f))};
}

Method filterMethod(const std::string& name, const SensorModel& sensor, const Settings& settings) {
    if (settings.options.window_scans > 1) {
        throw SettingsError("window_scans: methods segment each scan alone");
    }
    const auto filter = std::make_shared<HagenFilter>(filterFor(sensor, settings.options));
    // Scan folders store sensor poses, including the mount.
    const Attitude mount = settings.mount;
    const bool is_mounted_level = mount.roll_rad == 0 && mount.pitch_rad == 0;
    const std::optional<Attitude> otherwise =
        is_mounted_level ? std::nullopt : std::optional(mount);
    return {name, [filter, otherwise, airframe = settings.airframe.parts,
                   masked = Scan()](const ScanInput& input) mutable {
                const std::optional<Attitude> attitude = attitudeOf(input);
                const Scan* scan = &input.scan;
                if (!airframe.isEmpty()) {
                    masked = input.scan;
                    maskAirframe(airframe, masked);
                    scan = &masked;
                }
                return filter->segment(*scan, attitude ? attitude : otherwise).returns.label;
            }};
}

std::vector<Baseline> allBaselines(float zone_m) {
    std::vector<Baseline> all = baselines(zone_m);
#ifdef HAGEN_HAS_PCL_BASELINE
    for (const Baseline& baseline : pclBaselines(zone_m)) all.push_back(baseline);
#endif
    return all;
}

/// Returns the settings merged with those of a recording, if any.
Settings settingsFor(Settings settings, const std::filesystem::path& sensor_file) {
    if (std::filesystem::exists(sensor_file)) {
        mergeSettings(sensor_file, settings, SettingsOrigin::Recording);
    }
    return settings;
}

}  // namespace

std::vector<SweepPoint> rowsOf(const Settings& settings, const std::vector<std::string>& sweeps) {
    std::vector<SweepPoint> rows;
    if (sweeps.empty()) rows.push_back({"hagen", settings, "", ""});
    for (const std::string& sweep : sweeps) {
        const std::size_t equals = sweep.find('=');
        if (equals == std::string::npos || equals + 1 == sweep.size()) {
            throw SettingsError("--sweep: expected KEY=VALUE,VALUE,..., not '" + sweep + "'");
        }
        const std::string key = sweep.substr(0, equals);
        for (const std::string& value : base::split(sweep.substr(equals + 1), ',')) {
            SweepPoint row{key + "=" + value, settings, key, value};
            setOption(key, value, row.settings);
            for (const SweepPoint& other : rows) {
                if (other.name == row.name) {
                    throw SettingsError("--sweep: " + row.name + " is given twice");
                }
            }
            rows.push_back(row);
        }
    }
    return rows;
}

void addLabelRows(const std::vector<std::string>& texts, MethodSet& rows) {
    std::vector<std::string> taken;
    for (const SweepPoint& row : rows.filter) taken.push_back(row.name);
    if (rows.baselines) {
        for (const Baseline& row : allBaselines(rows.baselines->options.zone_m))
            taken.push_back(row.name);
    }
    for (const LabelRow& row : rows.labels) taken.push_back(row.name);
    for (const std::string& text : texts) {
        rows.labels.push_back(labelRowFrom(text, taken));
        taken.push_back(rows.labels.back().name);
    }
}

std::vector<Method> methodsFor(const MethodSet& rows, const std::filesystem::path& sensor_file,
                               const SharedBeams& beams) {
    const auto sensorOf = [&](const Settings& settings) {
        const SensorModel sensor = settings.sensorModel(beams.get());
        return rows.is_upside_down ? mirrored(sensor) : sensor;
    };
    std::vector<Method> methods;
    for (const SweepPoint& row : rows.filter) {
        Settings settings = settingsFor(row.settings, sensor_file);
        if (!row.sweep_key.empty())
            setOption(row.sweep_key, row.sweep_value, settings);  // overrides the folder's settings
        settings.options = settings.optionsFor(beams.get());
        methods.push_back(filterMethod(row.name, sensorOf(settings), settings));
    }
    if (!rows.baselines) return methods;
    const Settings settings = settingsFor(*rows.baselines, sensor_file);
    const SensorModel sensor = sensorOf(settings);
    std::vector<Baseline> all = allBaselines(settings.options.zone_m);
    for (const auto& [limit, values] : rows.limits) {
        for (const Baseline& baseline : allBaselines(settings.options.zone_m)) {
            if (baseline.limit != limit) continue;
            for (const std::string& value : values) {
                all.push_back(baseline.withLimit(std::stof(value)));
                all.back().name += ", " + limit + "=" + value;
            }
        }
    }
    for (const Baseline& baseline : all) {
        methods.push_back({baseline.name, [baseline, sensor](const ScanInput& input) {
                               return baseline.segment(input.scan, sensor);
                           }});
    }
    return methods;
}

}  // namespace hagen::evaluation
