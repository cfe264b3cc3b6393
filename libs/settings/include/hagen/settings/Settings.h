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

/// An invalid settings file or command-line setting. The message names the file and line, the key,
/// and the allowed values.
struct SettingsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The content of settings files: the filter's options, the sensor and the airframe.
struct Settings {
    Options options;
    /// The keys of `options` that a file or setOption() gave. These hold as they are, also for a
    /// recovered sensor, like options that differ from their default.
    std::set<std::string> given;
    /// All files that were read, in their order. No output may replace them.
    std::vector<std::filesystem::path> files;

    /// The section `sensor:` of a settings file. Defaults come from the model.
    struct Sensor {
        std::optional<std::string> model;    ///< none, "recovered" in files: see sensorModel()
        std::vector<double> elevations_deg;  ///< of model `custom`, lowest beam first
        std::optional<float> min_range_m, max_range_m;
    };
    Sensor sensor;
    /// The sensor's roll and pitch on the level vehicle (`mount_roll_deg` and `mount_pitch_deg` of
    /// the section `sensor:`), for logs that do not say. Not part of `sensor`: the mount stays when
    /// a later file names another model.
    Attitude mount;
    /// The sensor's tilt while the vehicle is level, by its mount; none: it is level, too.
    std::optional<Attitude> tiltOnLevelVehicle() const;

    /// The section `airframe:` of a settings file: the vehicle's own parts, in the frame of the
    /// sensor itself. Holds for every LiDAR that is segmented with these settings. A later file
    /// with this section replaces the whole of it.
    struct AirframeMask {
        Airframe parts;
        std::filesystem::path learned;  ///< absolute; the file of `bin_range_m`; empty: none
    };
    AirframeMask airframe;

    /// Returns the sensor of a cloud: the model that the settings name, otherwise the one that was
    /// recovered from such clouds (CloudSensors), otherwise a VLP-16. Range limits of the settings
    /// hold for all of them. Throws SettingsError for `custom` without elevations, and for limits
    /// that contradict each other.
    SensorModel sensorModel(const RecoveredBeams* recovered = nullptr) const;

    /// Returns the options for the sensor that sensorModel() returns. For a recovered sensor, what
    /// is not given is adapted to it: `columns` are at most those that its returns fill,
    /// `window_size` is at most half of its rows, `principal_components` are the same share of it.
    Options optionsFor(const RecoveredBeams* recovered) const;
};

/// Returns the filter for a sensor. Throws SettingsError if the options do not fit it.
HagenFilter filterFor(const SensorModel& sensor, const Options& options);

/// Who wrote a settings file.
enum class SettingsOrigin {
    User,
    Recording,  ///< it came with data: it may include files of its own folder only
};

/// Merges a YAML file into `settings`, key by key. Its `include: FILE` (relative to itself, or a
/// preset of Presets.h, or a list of these) is merged before its own keys. Throws SettingsError if
/// a file cannot be read or parsed, a key is unknown or occurs twice, or a value has the wrong type
/// or is out of range, or if a limit is exceeded: 1 MiB a file, includes 8 deep and 32 in all;
/// `settings` is then unchanged.
void mergeSettings(const std::filesystem::path& file, Settings& settings,
                   SettingsOrigin origin = SettingsOrigin::User);

/// Returns an angle in degrees, with as few decimals as read back as the same angle.
std::string degreesText(float angle_rad);

/// Returns the current settings as a settings file, with each key's unit and meaning in a comment.
/// Reading it returns the same settings.
std::string dumpSettings(const Settings& settings);

/// A row of the table of valid keys in settings files.
struct SettingsKey {
    std::string name, unit, standard, range, what;
    std::string symbol;  ///< the symbol in the paper; empty: none
};
/// Returns every key: those of optionKeys(), the sensor's, `airframe` and `include`.
std::vector<SettingsKey> settingsKeys();

/// Sets one option from text, as `--sweep KEY=VALUE` does, by its name with or without section.
/// Throws SettingsError.
void setOption(const std::string& key, const std::string& value, Settings& settings);

}  // namespace hagen
