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
    /// The keys of `options` that a file or setOption() gave. A recovered sensor does not adapt
    /// these, nor options that differ from their default.
    std::set<std::string> given;
    /// All files read, in order. No output may replace them.
    std::vector<std::filesystem::path> files;

    /// The section `sensor:` of a settings file. Defaults come from the model.
    struct Sensor {
        std::optional<std::string> model;    ///< none ("recovered" in files): see sensorModel()
        std::vector<double> elevations_deg;  ///< for model `custom`, lowest beam first
        std::optional<float> min_range_m, max_range_m;
    };
    Sensor sensor;
    /// The sensor's roll and pitch on the level vehicle (`mount_roll_deg` and `mount_pitch_deg` of
    /// the section `sensor:`), for logs without them. Not part of `sensor`: the mount is kept when
    /// a later file names another model.
    Attitude mount;
    /// The sensor's tilt on a level vehicle, from its mount; none: the sensor is level.
    std::optional<Attitude> tiltOnLevelVehicle() const;

    /// The section `airframe:` of a settings file: the vehicle's parts in the sensor's own frame.
    /// Applies to every LiDAR segmented with these settings. A later file with this section
    /// replaces all of it.
    struct AirframeMask {
        Airframe parts;
        std::filesystem::path learned;  ///< absolute; the file of `bin_range_m`; empty: none
    };
    AirframeMask airframe;

    /// Returns the sensor of a cloud: the model that the settings name, otherwise the one recovered
    /// from such clouds (CloudSensors), otherwise a VLP-16. Range limits of the settings apply to
    /// all of these. Throws SettingsError for `custom` without elevations, and for contradictory
    /// limits.
    SensorModel sensorModel(const RecoveredBeams* recovered = nullptr) const;

    /// Returns the options for the sensor that sensorModel() returns. For a recovered sensor,
    /// options that are not given are adapted: `columns` is at most the number that its returns
    /// fill, `window_size` at most half of its rows, `principal_components` the same share of
    /// `window_size` as by default.
    Options optionsFor(const RecoveredBeams* recovered) const;
};

/// Returns the filter for a sensor. Throws SettingsError if the options do not fit it.
HagenFilter filterFor(const SensorModel& sensor, const Options& options);

/// The origin of a settings file.
enum class SettingsOrigin {
    User,
    Recording,  ///< came with data: may include only files of its own folder
};

/// Merges a YAML file into `settings`, key by key. Its `include: FILE` (relative to itself, or a
/// preset of Presets.h, or a list of these) is merged before its own keys. Throws SettingsError and
/// leaves `settings` unchanged if a file cannot be read or parsed, a key is unknown or occurs
/// twice, a value has the wrong type or is out of range, or a limit is exceeded: 1 MiB per file, 8
/// levels of includes and 32 includes in total.
void mergeSettings(const std::filesystem::path& file, Settings& settings,
                   SettingsOrigin origin = SettingsOrigin::User);

/// Returns an angle in degrees, with the fewest decimals that read back as the same angle.
std::string degreesText(float angle_rad);

/// Returns the current settings as a settings file, with each key's unit and meaning in a comment.
/// Reading it returns the same settings.
std::string dumpSettings(const Settings& settings);

/// A row of the table of valid keys in settings files.
struct SettingsKey {
    std::string name, unit, standard, range, what;
    std::string symbol;  ///< the symbol in the paper; empty: none
};
/// Returns all keys: those of optionKeys(), the sensor's, `airframe` and `include`.
std::vector<SettingsKey> settingsKeys();

/// Sets one option from text, as `--sweep KEY=VALUE` does, by its name with or without the section.
/// Throws SettingsError.
void setOption(const std::string& key, const std::string& value, Settings& settings);

}  // namespace hagen
