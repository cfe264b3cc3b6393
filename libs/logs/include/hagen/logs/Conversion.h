#pragma once
#include <hagen/logs/ScanSource.h>
#include <hagen/mapping/ScanMap.h>
#include <hagen/observations/ObservationScan.h>
#include <hagen/observations/Settings.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hagen::logs {

/// A log to segment, and what to write of it. Outputs with an empty name are not written.
struct Conversion {
    std::filesystem::path input;  ///< a .rawlog, or a scan folder

    std::filesystem::path rawlog;    ///< segmented rawlog
    std::filesystem::path folder;    ///< scan folder; of several LiDARs a folder of such
    std::filesystem::path pictures;  ///< folder of pictures of each stage, a folder a scan
    std::vector<std::filesystem::path> octomaps;  ///< .bt, .ot or .3Dscene: one map, file by file
    mapping::ScanMapOptions octomap;              ///< what goes into it
    std::filesystem::path stats;  ///< JSON: settings in force, counts, a line a scan
    bool overwrite = false;       ///< replace outputs that exist

    std::filesystem::path poses;  ///< where the vehicle was (TUM, KITTI); empty: what the log tells
    std::size_t from = 0;         ///< first and last entry to convert, both included
    std::size_t to = std::numeric_limits<std::size_t>::max();
    std::vector<std::string> sensor_labels;  ///< LiDARs to segment; empty: all
    observations::CloudClass cloud_class = observations::CloudClass::Simple;
    std::size_t jobs = 0;  ///< threads; 0: as many as there are cores. No output depends on it
    bool preview = false;  ///< adds a coloured scene after each pair of clouds
    std::optional<float>
        picture_azimuth_deg;  ///< of the column drawn; none: the nearest obstacle's
    observations::Settings settings;
};

/// What became of one scan.
struct ScanReport {
    std::size_t entry;         ///< of the input, counted from 0; of a scan folder: the scan
    std::string sensor_label;  ///< of a scan folder: "velodyne"
    std::string name;          ///< its name in a scan folder
    double time_s;
    std::size_t returns, roi, rou, unclassified;
    std::size_t obstacles;  ///< RoI components
    float nearest_roi_m;    ///< NaN where there is no RoI
    double latency_ms;      ///< from the observation in memory to its labels
};

/// What was read, and what the filter said of it.
struct ConversionReport {
    std::size_t entries = 0;  ///< entries converted; all are in the output
    std::size_t scans = 0;    ///< of them, or in them: LiDAR scans that were segmented
    std::size_t returns = 0, roi = 0, rou = 0, unclassified = 0;
    std::size_t unreadable_scans = 0;  ///< kept, but not segmented; the listener was told of each
    std::size_t left_out_before = 0;   ///< entries before `from`
    /// The sensor of each sensor label, as a user should read it: "VLP-16, 16 beams".
    std::map<std::string, std::string> sensors;
    std::string poses;  ///< where they come from; empty: none needed, or none known
    std::size_t scans_with_pose = 0;
    std::size_t scans_in_map = 0;         ///< of an OctoMap; those without a pose are not
    std::size_t scans_with_attitude = 0;  ///< how the sensor was tilted was known
    std::vector<ScanReport> scan_reports;
    double fraction = 0;  ///< of the input that is read, 0 ... 1
    observations::Settings
        settings;  ///< in force: those of the conversion, and of a scan folder's sensor.yaml
};

/// What a conversion tells and asks while it goes on: in the log's order, one call at a time, but
/// not always on the same thread.
struct ConversionListener {
    /// After each entry.
    std::function<void(const ConversionReport&)> progress = [](const auto&) {};
    /// About one entry: what it is ("entry 12 (lidar)"), and what a user should know.
    std::function<void(const std::string& entry, const std::string& remark)> remark =
        [](const auto&, const auto&) {};
    /// About a scan that is kept, but could not be segmented: what it is, and why.
    std::function<void(const std::string& entry, const std::string& why)> unreadable =
        [](const auto&, const auto&) {};
    /// Asked before each entry is read; no ends the conversion with Interrupted, once those before
    /// it are converted.
    std::function<bool()> keep_going = [] { return true; };
};

/// Segments a whole log, a few entries in memory at a time: two for each of `jobs` threads, of
/// which there is but one where pictures are drawn.
///
/// A segmented rawlog keeps every entry of the input in its order. After each LiDAR observation
/// come its `_roi` and `_non_roi` clouds, and its preview if asked for; in a sensory frame they
/// join the frame. A scan folder as input becomes one observation a scan. The written scan folder
/// has the names and the order of points of the one read, or counts the scans of a log.
///
/// With a window of several scans, poses come from a file, or from the log; a scan without one is
/// segmented alone, which a remark says.
///
/// An OctoMap needs poses. It takes each return by the pose at its own time where that is known,
/// and leaves out scans without a pose, which remarks say.
///
/// Outputs appear under their names when they are whole. Throws std::runtime_error, naming file and
/// entry, where it fails; a log that breaks off, or a listener that ends it, leaves what was done
/// before in OUT.partial.rawlog (DIR.partial), which the message says. Throws SettingsError where
/// options do not fit a sensor.
ConversionReport convert(const Conversion& conversion, const ConversionListener& listener = {});

}  // namespace hagen::logs
