#include <yaml-cpp/yaml.h>

#include <hagen/scan/Angle.h>
#include <hagen/settings/Presets.h>
#include <hagen/settings/Settings.h>
#include <algorithm>
#include <iomanip>
#include <map>
#include "base/NumberText.h"
#include "base/TextStream.h"
#include "filter/OptionKeys.h"
#include "settings/MaxRange.h"

#include "base/Text.h"
#include "settings/AirframeSettings.h"
#include "settings/YamlParts.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
// Limits of settings files, which may come from untrusted recordings.
constexpr int kMaxIncludeDepth = 8, kMaxIncludes = 32;
constexpr std::size_t kMaxFileBytes = 1 << 20;

Seeds parseSeeds(const YAML::Node& node, const std::string& key) {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (text == "lowest") return Seeds::Lowest;
    if (text == "top_and_nearest") return Seeds::TopAndNearest;
    if (text == "every") return Seeds::Every;
    throw SettingsError(key + " must be 'lowest', 'top_and_nearest' or 'every', not '" + text +
                        "'");
}

bool parseSwitch(const YAML::Node& node, const std::string& key) {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (text == "true") return true;
    if (text == "false") return false;
    throw SettingsError(key + " must be 'true' or 'false', not '" + text + "'");
}

void parseOption(const OptionKey& key, const YAML::Node& node, Options& options) {
    if (const auto* real = std::get_if<float Options::*>(&key.field)) {
        options.*(*real) = parseNumber<float>(node, key.name, key.min, key.max);
    } else if (const auto* whole = std::get_if<int Options::*>(&key.field)) {
        options.*(*whole) = parseNumber<int>(node, key.name, key.min, key.max);
    } else if (const auto* yes = std::get_if<bool Options::*>(&key.field)) {
        options.*(*yes) = parseSwitch(node, key.name);
    } else {
        options.*std::get<Seeds Options::*>(key.field) = parseSeeds(node, key.name);
    }
}

// Minimum values in optionKeys().
constexpr int kMinColumns = 8, kMinWindow = 2;

/// The keys of the section `sensor:`.
const std::vector<SettingsKey>& sensorKeys() {
    static const std::vector<SettingsKey> keys{
        {"model", "", kRecoveredName,
         base::joined(knownSensorModels(), ", ") + ", custom, " + kRecoveredName,
         "sensor of point clouds; packets identify their own sensor", ""},
        {"elevations_deg", "deg", "", "-90 ... 90, ascending, 2 to 256 of them",
         "beams of a custom sensor, lowest first", ""},
        {"min_range_m", "m", "the model's", "0 ... " + base::shortestText(kMaxRange_m),
         "nearer returns are RoI without a test", ""},
        {"max_range_m", "m", "the model's", "0 ... " + base::shortestText(kMaxRange_m),
         "farther returns are RoI within the zone, without a test; ROU beyond", ""},
        {"mount_roll_deg", "deg", "0", "-180 ... 180",
         "roll of the sensor on a level vehicle, if the log lacks it", ""},
        {"mount_pitch_deg", "deg", "0", "-90 ... 90",
         "pitch of the sensor on a level vehicle, if the log lacks it", ""}};
    return keys;
}

std::vector<std::string> namesOf(const std::vector<SettingsKey>& keys) {
    std::vector<std::string> names;
    for (const SettingsKey& key : keys) names.push_back(key.name);
    return names;
}

const OptionKey* findOption(const std::string& name) {
    for (const OptionKey& key : optionKeys()) {
        if (key.name == name) return &key;
    }
    return nullptr;
}

constexpr const char* kPaper = "paper";

/// Sets an option and marks it as given. `seen`: options given so far in this file.
void mergeOption(const fs::path& file, const OptionKey& key, const YAML::Node& value,
                 std::set<std::string>& seen, Settings& settings) {
    if (!seen.insert(key.name).second) {
        throw SettingsError(at(file, value) + "'" + key.name +
                            "' is both a top-level key and a key of '" + key.section +
                            "'; keep only one");
    }
    try {
        parseOption(key, value, settings.options);
        settings.given.insert(key.name);
    } catch (const SettingsError& e) {
        throw SettingsError(at(file, value) + e.what());
    }
}

void parseReadings(const fs::path& file, const YAML::Node& section, std::set<std::string>& seen,
                   Settings& settings) {
    std::vector<std::string> known;
    for (const OptionKey& key : optionKeys()) {
        if (key.section == kPaper) known.push_back(key.name);
    }
    forEachKey(file, section, kPaper, "'seeds: every'",
               [&](const std::string& name, const YAML::Node& value, const std::string& place) {
                   const OptionKey* const key = findOption(name);
                   if (key == nullptr || key->section != kPaper) {
                       throw SettingsError(place + unknownKey(name, known) + " (in 'paper')");
                   }
                   mergeOption(file, *key, value, seen, settings);
               });
}

float parseAngle(const YAML::Node& node, const std::string& key, double max_deg) {
    return static_cast<float>(radians(parseNumber<double>(node, key, -max_deg, max_deg)));
}

/// Throws std::invalid_argument if the sensor name is unknown.
void checkModel(const std::string& name) {
    try {
        hagen::sensorModel(name);
    } catch (const std::invalid_argument& e) {
        throw std::invalid_argument(e.what() + base::didYouMean(name, knownSensorModels()) + " '" +
                                    kRecoveredName + "' recovers the beams from the clouds");
    }
}

void parseSensor(const fs::path& file, const YAML::Node& section, Settings& settings) {
    Settings::Sensor& sensor = settings.sensor;
    // A new model replaces all settings of the previous sensor.
    if (section.IsMap() && section["model"]) sensor = {};
    forEachKey(
        file, section, "sensor", "'model: VLP-16'",
        [&](const auto& key, const auto& value, const auto&) {
            try {
                if (key == "model") {
                    if (!value.IsScalar()) throw SettingsError("sensor.model must be a name");
                    const std::string& name = value.Scalar();
                    if (name != "custom" && name != kRecoveredName) checkModel(name);
                    if (name != kRecoveredName) sensor.model = name;
                } else if (key == "elevations_deg") {
                    if (!value.IsSequence()) {
                        throw SettingsError(
                            "sensor.elevations_deg must be a list, lowest beam first");
                    }
                    sensor.elevations_deg.clear();
                    for (const YAML::Node& elevation : value) {
                        sensor.elevations_deg.push_back(parseNumber<double>(
                            elevation, "each of sensor.elevations_deg", -90, 90));
                    }
                    customSensorModel(sensor.elevations_deg);
                } else if (key == "min_range_m") {
                    sensor.min_range_m =
                        parseNumber<float>(value, "sensor.min_range_m", 0, kMaxRange_m);
                } else if (key == "max_range_m") {
                    sensor.max_range_m =
                        parseNumber<float>(value, "sensor.max_range_m", 0, kMaxRange_m);
                } else if (key == "mount_roll_deg") {
                    settings.mount.roll_rad = parseAngle(value, "sensor.mount_roll_deg", 180);
                } else if (key == "mount_pitch_deg") {
                    settings.mount.pitch_rad = parseAngle(value, "sensor.mount_pitch_deg", 90);
                } else {
                    throw SettingsError(unknownKey(key, namesOf(sensorKeys())) + " (in 'sensor')");
                }
            } catch (const std::exception& e) {
                throw SettingsError(at(file, value) + e.what());
            }
        });
    if (!sensor.elevations_deg.empty() && sensor.model.value_or("") != "custom") {
        throw SettingsError(
            at(file, section) +
            "sensor.elevations_deg requires 'model: custom'; a known model has its own");
    }
}

/// True if the option is adapted when the sensor is recovered.
bool isAdapted(const std::string& name, const Settings& settings) {
    if (settings.sensor.model || settings.given.count(name) > 0) return false;
    if (name != "columns" && name != "window_size" && name != "principal_components") return false;
    const OptionKey& key = *findOption(name);
    return textOf(key, settings.options) == textOf(key, Options());
}

/// Number of files included so far, and the current depth.
struct Includes {
    SettingsOrigin origin;
    int depth = 0, files = 0;
};

void mergeFile(const fs::path& file, Includes& includes, Settings& settings);

constexpr std::size_t kMaxNameLength = 4000;

void mergeIncludes(const fs::path& file, const YAML::Node& node, Includes& includes,
                   Settings& settings) {
    if (includes.depth >= kMaxIncludeDepth) {
        throw SettingsError(at(file, node) + "include is circular or nested too deeply");
    }
    const YAML::Node names = node.IsSequence() ? node : YAML::Load("[]");
    if (!node.IsSequence() && !node.IsScalar()) {
        throw SettingsError(at(file, node) + "include must be a file name or a list of them");
    }
    const auto merge = [&](const std::string& name) {
        if (includes.origin == SettingsOrigin::Recording && fs::path(name).has_parent_path()) {
            throw SettingsError(at(file, node) + "includes '" + name +
                                "'; settings that come with a recording may include only files of "
                                "their own folder");
        }
        if (name.empty() || name.size() > kMaxNameLength || name.find('\0') != std::string::npos) {
            throw SettingsError(at(file, node) + "an entry of 'include' is not a file name");
        }
        fs::path included = file.parent_path() / name;
        std::error_code none;
        if (!fs::exists(included, none)) {
            const fs::path preset = findPreset(name);
            if (preset.empty()) {
                throw SettingsError(at(file, node) + "includes " + included.string() +
                                    ", but there is no such file or preset");
            }
            included = preset;
        }
        if (!fs::is_regular_file(included, none)) {
            throw SettingsError(at(file, node) + "includes " + included.string() +
                                ", which is not a file");
        }
        if (++includes.files > kMaxIncludes) {
            throw SettingsError(at(file, node) + "settings include more than " +
                                std::to_string(kMaxIncludes) + " files");
        }
        ++includes.depth;
        mergeFile(included, includes, settings);
        --includes.depth;
    };
    if (node.IsScalar()) merge(node.Scalar());
    for (const YAML::Node& name : names) merge(name.as<std::string>(""));
}

void mergeKeys(const fs::path& file, const YAML::Node& document, Includes& includes,
               Settings& settings) {
    if (document["include"]) mergeIncludes(file, document["include"], includes, settings);
    std::vector<std::string> known{"include", "sensor", "airframe", kPaper};
    for (const OptionKey& key : optionKeys()) known.push_back(key.name);
    std::set<std::string> seen;
    const auto read = [&](const std::string& name, const YAML::Node& value,
                          const std::string& place) {
        if (name == "include") return;
        if (name == "sensor") {
            parseSensor(file, value, settings);
        } else if (name == kPaper) {
            parseReadings(file, value, seen, settings);
        } else if (name == "airframe") {
            settings.airframe = parseAirframe(file, value, includes.origin);
            if (!settings.airframe.learned.empty()) {
                settings.files.push_back(settings.airframe.learned);
            }
        } else if (const OptionKey* key = findOption(name)) {
            mergeOption(file, *key, value, seen, settings);
        } else {
            throw SettingsError(place + unknownKey(name, known));
        }
    };
    forEachKey(file, document, "", "", read);
}

void mergeFile(const fs::path& file, Includes& includes, Settings& settings) {
    const YAML::Node document = parseFile(file, kMaxFileBytes);
    settings.files.push_back(file);
    if (document.IsNull()) return;  // empty, or only comments
    if (!document.IsMap()) {
        throw SettingsError(file.string() + ": not a settings file: expected 'key: value' lines");
    }
    mergeKeys(file, document, includes, settings);
}

}  // namespace

SensorModel Settings::sensorModel(const RecoveredBeams* recovered) const {
    if (sensor.model == "custom" && sensor.elevations_deg.empty()) {
        throw SettingsError("sensor.model is 'custom', but there is no sensor.elevations_deg");
    }
    SensorModel model = sensor.model == "custom" ? customSensorModel(sensor.elevations_deg)
                        : !sensor.model && recovered != nullptr
                            ? recovered->sensor
                            : hagen::sensorModel(sensor.model.value_or("VLP-16"));
    model.min_range_m = sensor.min_range_m.value_or(model.min_range_m);
    model.max_range_m = sensor.max_range_m.value_or(model.max_range_m);
    if (!(model.min_range_m < model.max_range_m)) {
        throw SettingsError("sensor.min_range_m (" + base::shortestText(model.min_range_m) +
                            ") is not below sensor.max_range_m (" +
                            base::shortestText(model.max_range_m) + ")");
    }
    return model;
}

std::optional<Attitude> Settings::tiltOnLevelVehicle() const {
    if (mount.roll_rad == 0 && mount.pitch_rad == 0) return std::nullopt;
    return mount;
}

Options Settings::optionsFor(const RecoveredBeams* recovered) const {
    if (sensor.model || recovered == nullptr) return options;
    const Options standard;
    Options fitting = options;
    if (isAdapted("columns", *this)) {
        fitting.columns = std::clamp(recovered->max_columns, kMinColumns, options.columns);
    }
    if (isAdapted("window_size", *this)) {
        const int half = recovered->sensor.rows() / 2;
        fitting.window_size = std::clamp(half, kMinWindow, options.window_size);
    }
    if (isAdapted("principal_components", *this)) {
        const double share = static_cast<double>(standard.principal_components) /
                             static_cast<double>(standard.window_size);
        const int components = static_cast<int>(std::lround(share * fitting.window_size));
        fitting.principal_components = std::min(components, options.principal_components);
    }
    return fitting;
}

HagenFilter filterFor(const SensorModel& sensor, const Options& options) {
    if (!(sensor.min_range_m < sensor.max_range_m)) {
        throw SettingsError("sensor.min_range_m (" + base::shortestText(sensor.min_range_m) +
                            ") must be less than sensor.max_range_m (" +
                            base::shortestText(sensor.max_range_m) + ")");
    }
    try {
        return HagenFilter(sensor, options);
    } catch (const std::invalid_argument& e) {
        throw SettingsError(e.what());
    }
}

void mergeSettings(const std::filesystem::path& file, Settings& settings, SettingsOrigin origin) {
    Settings merged = settings;
    Includes includes{origin};
    mergeFile(file, includes, merged);
    settings = merged;
}

void mergeKey(const std::string& assignment, Settings& settings) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw SettingsError("--set " + assignment + ": expected KEY=VALUE, such as zone_m=10");
    }
    const std::string key = assignment.substr(0, equals), place = "--set " + key;
    const std::size_t dot = key.find('.');
    YAML::Node document;
    try {
        const std::string text = assignment.substr(equals + 1);
        const bool is_list = !text.empty() && text[0] == '[';
        const YAML::Node value = is_list ? YAML::Load(text) : YAML::Node(text);
        if (dot == std::string::npos) {
            document[key] = value;
        } else {
            document[key.substr(0, dot)][key.substr(dot + 1)] = value;
        }
    } catch (const YAML::Exception& e) {
        throw SettingsError(place + ": " + e.msg);
    }
    Settings merged = settings;
    Includes includes{SettingsOrigin::User};
    mergeKeys(place, document, includes, merged);
    settings = merged;
}

std::string degreesText(float angle_rad) {
    const double angle_deg = degrees(static_cast<double>(angle_rad));
    for (int decimals = 0; decimals < 10; ++decimals) {
        const std::string text = base::fixedText(angle_deg, decimals);
        const double read_deg = base::numberFrom<double>(text).value();
        if (static_cast<float>(radians(read_deg)) == angle_rad) return text;
    }
    return base::shortestText(angle_deg);
}

std::string dumpSettings(const Settings& settings) {
    base::TextStream text;
    const auto line = [&](const std::string& key, const std::string& value, const SettingsKey& k) {
        text << std::left << std::setw(32) << (key + ": " + value) << " # "
             << (k.unit.empty() ? "" : "[" + k.unit + "] ") << k.what
             << (k.symbol.empty() ? "" : " (the paper's " + k.symbol + ")") << "\n";
    };
    const auto options = [&](const std::string& section, const std::string& indent) {
        for (const OptionKey& key : optionKeys()) {
            if (key.section != section) continue;
            // Options given in a file are not adapted.
            const std::string comment = isAdapted(key.name, settings) ? "# " : "";
            line(indent + comment + key.name, textOf(key, settings.options),
                 {key.name, key.unit, "", "", key.what, key.symbol});
        }
    };
    options("", "");
    text << kPaper << ":  # readings of the paper\n";
    options(kPaper, "  ");
    const Settings::Sensor& sensor = settings.sensor;
    std::map<std::string, std::string> values;
    values["model"] = sensor.model.value_or(kRecoveredName);
    std::vector<std::string> elevations;
    for (const double elevation : sensor.elevations_deg)
        elevations.push_back(base::shortestText(elevation));
    if (!elevations.empty()) values["elevations_deg"] = "[" + base::joined(elevations, ", ") + "]";
    const auto limit = [&](const char* key, std::optional<float> value) {
        if (value) values[key] = base::shortestText(*value);
    };
    limit("min_range_m", sensor.min_range_m);
    limit("max_range_m", sensor.max_range_m);
    if (settings.mount.roll_rad != 0) {
        values["mount_roll_deg"] = degreesText(settings.mount.roll_rad);
    }
    if (settings.mount.pitch_rad != 0) {
        values["mount_pitch_deg"] = degreesText(settings.mount.pitch_rad);
    }
    text << "sensor:\n";
    for (const SettingsKey& key : sensorKeys()) {
        const auto value = values.find(key.name);
        if (value != values.end()) line("  " + key.name, value->second, key);
    }
    text << airframeText(settings.airframe);
    return text.str();
}

std::vector<SettingsKey> settingsKeys() {
    std::vector<SettingsKey> keys;
    for (const OptionKey& key : optionKeys()) {
        keys.push_back({nameInFiles(key), key.unit, textOf(key, Options()), rangeOf(key), key.what,
                        key.symbol});
    }
    for (SettingsKey key : sensorKeys()) {
        key.name = "sensor." + key.name;
        keys.push_back(key);
    }
    keys.push_back({"airframe", "", "", "a list of box, sphere, learned",
                    "parts of the vehicle; their returns are unclassified", ""});
    keys.push_back({"include", "", "", "a file, or a list", "files merged before this one", ""});
    return keys;
}

void setOption(const std::string& key, const std::string& value, Settings& settings) {
    std::vector<std::string> known;
    for (const OptionKey& option : optionKeys()) {
        known.push_back(option.name);
        if (key != option.name && key != nameInFiles(option)) continue;
        parseOption(option, YAML::Node(value), settings.options);
        settings.given.insert(option.name);
        return;
    }
    throw SettingsError(unknownKey(key, known));
}

}  // namespace hagen
