#pragma once
#include <hagen/range_image/SensorModel.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/Options.h>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::observations {

/// A settings file, or a setting on the command line, that cannot be taken as it is. The message
/// names the file and line, the key, and what is allowed.
struct SettingsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// All that settings files say: the filter's options, and the sensor.
struct Settings {
    Options options;

    /// The section `sensor:` of a settings file. What is not given comes from the model.
    struct Sensor {
        std::optional<std::string> model;
        std::vector<double>
            elevations_deg;  ///< of model `custom`, from the lowest beam to the highest
        std::optional<float> min_range_m, max_range_m;
    };
    Sensor sensor;

    /// The sensor that these settings describe; a VLP-16 where they name none.
    /// Throws SettingsError for `custom` without elevations.
    SensorModel sensorModel() const;
};

/// The filter for a sensor. Throws SettingsError where the options do not fit it.
HagenFilter filterFor(const SensorModel& sensor, const Options& options);

/// Merges a YAML file into `settings`, key by key. Its `include: FILE` (relative to itself, or a
/// list of files) is merged before its own keys. Throws SettingsError for a file that cannot be
/// read or parsed, a key that is unknown or there twice, and a value of the wrong type or out of
/// range; `settings` is unchanged then.
void mergeSettings(const std::filesystem::path& file, Settings& settings);

/// The settings in force as a settings file, each key with its unit and meaning in a comment. It
/// reads back as the same settings.
std::string dumpSettings(const Settings& settings);

/// A line of the table of keys that settings files may hold.
struct SettingsKey {
    std::string name, unit, standard, range, what;
    std::string symbol;  ///< the paper's; empty where it has none
};
/// Every key: those of optionKeys(), the sensor's, and `include`.
std::vector<SettingsKey> settingsKeys();

/// Sets one option from text, as `--sweep KEY=VALUE` does. Throws SettingsError.
void setOption(const std::string& key, const std::string& value, Settings& settings);

}  // namespace hagen::observations
