#pragma once
#include <hagen/observations/Settings.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace hagen {

/// A log to segment, and what to write of it.
struct Conversion {
    std::filesystem::path input;   ///< a .rawlog, or a scan folder
    std::filesystem::path rawlog;  ///< segmented rawlog to write; empty: none
    std::filesystem::path folder;  ///< scan folder to write; empty: none
    bool overwrite = false;        ///< replace outputs that exist
    Settings settings;
};

/// What was read, and what the filter said of it.
struct ConversionReport {
    std::size_t entries = 0;  ///< entries of the input; all are in the output
    std::size_t scans = 0;    ///< of them, or in them: LiDAR scans that were segmented
    std::size_t returns = 0, roi = 0, rou = 0, unclassified = 0;
    std::size_t unreadable_scans = 0;  ///< kept, but not segmented; the listener was told of each
    /// The sensor of each sensor label, as a user should read it: "VLP-16, 16 beams".
    std::map<std::string, std::string> sensors;
};

/// What a conversion tells while it goes on.
struct ConversionListener {
    /// After each entry.
    std::function<void(const ConversionReport&)> progress = [](const auto&) {};
    /// About one entry: what it is ("entry 12 (lidar)"), and what a user should know.
    std::function<void(const std::string& entry, const std::string& remark)> remark =
        [](const auto&, const auto&) {};
    /// About a scan that is kept, but could not be segmented: what it is, and why.
    std::function<void(const std::string& entry, const std::string& why)> unreadable =
        [](const auto&, const auto&) {};
};

/// Segments a whole log, one entry in memory at a time.
///
/// A segmented rawlog keeps every entry of the input in its order. After each LiDAR observation
/// come its `_roi` and `_non_roi` clouds; in a sensory frame they join the frame. A scan folder as
/// input becomes one observation a scan. The written scan folder has the names and the order of
/// points of the one read, or counts the scans of a log.
///
/// With a window of several scans, poses come from the log's CObservationRobotPose or the folder's
/// poses.txt; a scan without one is segmented alone, which a remark says.
///
/// Outputs appear under their names when they are whole. Throws std::runtime_error, naming file and
/// entry, where it fails; a log that breaks off leaves what was read before in OUT.partial.rawlog
/// (DIR.partial), which the message says. Throws SettingsError where options do not fit a sensor.
ConversionReport convert(const Conversion& conversion, const ConversionListener& listener = {});

}  // namespace hagen
