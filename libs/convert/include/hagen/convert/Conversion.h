#pragma once
#include <hagen/convert/WriteCloud.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/recordings/ScanSource.h>
#include <hagen/settings/Settings.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hagen::convert {

/// A log to segment, and the outputs to write. Outputs with an empty name are not written.
struct Conversion {
    std::filesystem::path input;  ///< see openRecording()
    /// Which scans to convert, and how to read them; without folder_objects and callbacks.
    recordings::SourceOptions source;

    std::filesystem::path rawlog;  ///< segmented rawlog
    std::filesystem::path folder;  ///< scan folder; with several LiDARs, one subfolder per LiDAR
    std::filesystem::path clouds;  ///< labelled clouds with all fields, one file per scan
    OutputFormat cloud_format = OutputFormat::Ply;
    std::filesystem::path mcap;      ///< labelled clouds, boxes and poses as ROS 2 messages
    std::filesystem::path pictures;  ///< pictures of each stage, one subfolder per scan
    std::filesystem::path view;      ///< HTML page that plays the scans
    std::size_t view_every = 0;      ///< show every Nth scan; 0: see ViewOutput.h
    std::vector<std::filesystem::path> octomaps;  ///< the map in each format: .bt, .ot, .3Dscene
    observations::ScanMapOptions octomap;         ///< resolution and contents of the map
    std::filesystem::path
        stats;               ///< JSON: settings, counts, one line per scan; "-": standard output
    bool overwrite = false;  ///< replace existing outputs

    std::filesystem::path poses;  ///< vehicle poses (TUM, KITTI); empty for the poses of the log
    observations::CloudClass cloud_class = observations::CloudClass::Simple;
    std::size_t jobs = 0;  ///< number of threads, 0 for all cores; does not affect outputs
    bool preview = false;  ///< add a coloured scene per scan to the rawlog
    std::optional<float>
        picture_azimuth_deg;  ///< column to draw; default: column of the nearest obstacle
    Settings settings;
};

/// Results of one scan.
struct ScanReport {
    std::size_t entry;         ///< index of the entry in the input, or of the scan in a scan folder
    std::string sensor_label;  ///< "velodyne" for a scan folder, "lidar" for cloud files
    std::string name;          ///< name of the scan's files, without extension
    double time_s;
    std::size_t returns, roi, rou, unclassified;
    std::size_t returns_masked;  ///< unclassified returns from the airframe in the settings
    std::size_t obstacles;       ///< number of RoI components
    float nearest_roi_m;         ///< NaN if the scan has no RoI
    double latency_ms;           ///< time from the observation in memory to its labels
};

/// Results of a conversion.
struct ConversionReport {
    std::size_t entries = 0;  ///< converted entries, which are all in the output
    std::size_t scans = 0;    ///< segmented LiDAR scans in the converted entries
    std::size_t returns = 0, roi = 0, rou = 0, unclassified = 0;
    std::size_t returns_masked = 0;    ///< unclassified airframe returns
    std::size_t unreadable_scans = 0;  ///< scans kept but not segmented, and reported
    std::size_t results_replaced = 0;  ///< clouds and previews of an earlier run, not in the output
    std::size_t left_out_before = 0;   ///< entries skipped before the first
    /// Sensor description by sensor label: "VLP-16, 16 beams", or how the sensor was recovered
    /// (CloudSensors.h).
    std::map<std::string, std::string> sensors;
    /// Sensors that neither the log nor the settings name, and their image columns.
    struct Recovered {
        SharedBeams beams;
        int columns = 0;
    };
    std::map<std::string, Recovered> recovered;  ///< by sensor label
    std::string poses;  ///< source of the poses; empty if not needed or not available
    std::size_t scans_with_pose = 0;
    std::size_t clouds = 0, cloud_points = 0;  ///< numbers of labelled clouds and of their points
    struct Mcap {
        std::size_t scans = 0, points = 0, boxes = 0, messages = 0;
    };
    Mcap mcap;                                    ///< contents of the MCAP
    std::size_t view_frames = 0, view_every = 1;  ///< scans in the page, and their interval
    std::size_t scans_without_ground = 0;         ///< their returns in the zone are RoI
    std::size_t scans_in_map = 0;                 ///< scans in the OctoMap (those with a pose)
    std::size_t scans_with_attitude = 0;          ///< scans with known roll and pitch
    std::string first_without_attitude;           ///< "scan 0 (lidar)"; empty if there is none
    bool is_attitude_of_poses = false;  ///< interpolated poses; otherwise the log's latest
    std::vector<ScanReport> scan_reports;
    double fraction = 0;  ///< fraction of the input read so far, 0 ... 1
    Settings settings;    ///< settings of the conversion, merged with a scan folder's sensor.yaml
};

/// Callbacks of a conversion, called in log order and never concurrently, but possibly on different
/// threads.
struct ConversionListener {
    /// Called after each entry.
    std::function<void(const ConversionReport&)> progress = [](const auto&) {};
    /// Called with the title of an entry ("scan 12 (lidar)") and a remark for the user.
    std::function<void(const std::string& entry, const std::string& remark)> remark =
        [](const auto&, const auto&) {};
    /// Called with the title of a scan that could not be segmented, and the reason. The scan is
    /// kept.
    std::function<void(const std::string& entry, const std::string& why)> unreadable =
        [](const auto&, const auto&) {};
    /// Called before reading each entry. Returning false ends the conversion with Interrupted after
    /// converting the entries already read.
    std::function<bool()> keep_going = [] { return true; };
};

/// Segments a log. Holds one entry per thread in memory. Pictures are drawn on one thread.
///
/// A segmented rawlog keeps every entry of a rawlog, in order, but only the scans of a capture or
/// bag. Each LiDAR observation is followed, in the same sensory frame if any, by its `_roi` and
/// `_non_roi` clouds and the preview, if requested. The new results replace those of an earlier
/// run. Scan folders and labelled clouds keep the names of an input folder; scans of other
/// recordings are numbered.
///
/// An OctoMap needs poses. Each return is placed with the pose at its own time, if known. Scans
/// without a pose are skipped, with a remark.
///
/// Outputs are renamed into place when complete. Throws recordings::BrokenRecording if the
/// recording or a later step fails, and recordings::Interrupted if the listener stops the
/// conversion; both messages name the partial output, OUT.partial.rawlog or DIR.partial, with the
/// preceding entries. Throws SettingsError if options do not fit a sensor, and std::runtime_error
/// if an output failed or no entry was converted.
ConversionReport convert(const Conversion& conversion, const ConversionListener& listener = {});

}  // namespace hagen::convert
