#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/scan/Airframe.h>
#include <hagen/scan/RecoverBeams.h>
#include <hagen/scan/SensorModel.h>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen {

/// An invalid settings file or option. The message names the file and line, the key and the allowed
/// values.
struct SettingsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The content of settings files: the filter's options, the sensor and the airframe.
struct Settings {
    Options options;
    /// The options set by a file or setOption(). These, and options that differ from their
    /// defaults, are not adapted to a recovered sensor.
    std::set<std::string> given;
    /// All files read, in order. No output may overwrite them.
    std::vector<std::filesystem::path> files;

    /// The section `sensor:` of a settings file. Defaults come from the model.
    struct Sensor {
        std::optional<std::string> model;    ///< unset: "recovered" in files; see sensorModel()
        std::vector<double> elevations_deg;  ///< for model `custom`, lowest beam first
        std::optional<float> min_range_m, max_range_m;
    };
    Sensor sensor;
    /// The sensor's roll and pitch on the level vehicle (`mount_roll_deg` and `mount_pitch_deg` of
    /// the section `sensor:`), for logs that lack them. Not part of `sensor`, so that the mount is
    /// kept when a later file names another model.
    Attitude mount;
    /// The sensor's tilt on a level vehicle, from its mount; nullopt if the sensor is level.
    std::optional<Attitude> tiltOnLevelVehicle() const;

    /// The section `airframe:` of a settings file: the vehicle's parts in the sensor frame, for
    /// every LiDAR segmented with these settings. A later file with this section replaces it.
    struct AirframeMask {
        Airframe parts;
        std::filesystem::path learned;  ///< absolute path of the file of `bin_range_m`, if any
    };
    AirframeMask airframe;

    /// Returns the sensor of a cloud: the model in the settings, otherwise the sensor recovered
    /// from similar clouds (CloudSensors), otherwise a VLP-16. Applies the range limits in the
    /// settings to each of them. Throws SettingsError if a `custom` sensor lacks elevations, or if
    /// limits are contradictory.
    SensorModel sensorModel(const RecoveredBeams* recovered = nullptr) const;

    /// Returns the options for the sensor of sensorModel(). For a recovered sensor, options that
    /// are not given are adapted: `columns` is limited to the number that its returns fill,
    /// `window_size` to half of its rows, and `principal_components` to the default share of
    /// `window_size`.
    Options optionsFor(const RecoveredBeams* recovered) const;
};

/// Returns the filter for a sensor. Throws SettingsError if the options do not suit the sensor.
HagenFilter filterFor(const SensorModel& sensor, const Options& options);

/// Where a settings file comes from.
enum class SettingsOrigin {
    User,
    Recording,  ///< part of a recording: may include only files in its own folder
};

/// Merges a YAML file into `settings`, key by key. First merges the files in its `include:` (a path
/// relative to the file, a preset of Presets.h, or a list of these). Throws SettingsError and
/// leaves `settings` unchanged if a file cannot be read or parsed, a key is unknown or occurs
/// twice, a value has the wrong type or is out of range, or a limit is exceeded: 1 MiB per file, 8
/// levels of includes and 32 includes in total.
void mergeSettings(const std::filesystem::path& file, Settings& settings,
                   SettingsOrigin origin = SettingsOrigin::User);

/// Merges one key, such as "zone_m=10", "sensor.model=OS1-64" or "airframe=[]", like a file with
/// this key. Throws SettingsError and leaves `settings` unchanged.
void mergeKey(const std::string& assignment, Settings& settings);

/// Returns an angle in degrees with the fewest decimals that convert back to the same angle.
std::string degreesText(float angle_rad);

/// Returns the settings as the text of a settings file, with each key's unit and meaning in a
/// comment. Reading the text restores the settings.
std::string dumpSettings(const Settings& settings);

/// A valid key of settings files.
struct SettingsKey {
    std::string name, unit, standard, range, what;
    std::string symbol;  ///< symbol in the paper; may be empty
};
/// Returns all keys: those of optionKeys() and of the sensor, `airframe` and `include`.
std::vector<SettingsKey> settingsKeys();

/// Sets an option from text, like `--sweep KEY=VALUE`, by its name with or without its section.
/// Throws SettingsError.
void setOption(const std::string& key, const std::string& value, Settings& settings);

}  // namespace hagen
