#include <hagen/recordings/ScanSource.h>

#include <hagen/base/Folder.h>
#include <hagen/recordings/BagFile.h>
#include <hagen/recordings/CloudFile.h>
#include <hagen/sensors/CaptureFile.h>
#include <algorithm>

#include "recordings/BagSource.h"
#include "recordings/CaptureSource.h"
#include "recordings/CloudFileSource.h"
#include "recordings/folders/ScanFolderSource.h"
#include "recordings/rawlogs/RawlogSource.h"

namespace hagen::recordings {

using mrpt::obs::CObservation;

std::optional<RecordedScan> ScanSource::nextScan() {
    while (waiting_.empty()) {
        auto entry = nextEntry();
        if (!entry) return std::nullopt;
        std::move(entry->scans.begin(), entry->scans.end(), std::back_inserter(waiting_));
    }
    RecordedScan scan = std::move(waiting_.front());
    waiting_.pop_front();
    return scan;
}

void ScanSource::usePoses(const std::filesystem::path& file) {
    poses_ = readPoses(file);
    is_levelled_by_file_ = !file.empty() && poses_.vehicle.has_horizon;
}

Settings ScanSource::useSettings(const Settings& settings) {
    Settings merged = settingsFor(settings);
    recovers_beams_ = !merged.sensor.model;
    return merged;
}

const observations::SharedBeams& ScanSource::beamsOf(const std::string& sensor_label) {
    const auto known = beams_.find(sensor_label);
    if (known != beams_.end()) return known->second;
    while (!sensors_.isSettled(sensor_label)) {
        checkInterruption();
        if (!showClouds(sensors_)) break;
    }
    return beams_[sensor_label] = sensors_.beamsOf(sensor_label);
}

Settings ScanSource::settingsFor(const Settings& settings) const { return settings; }

void ScanSource::brokeOffAhead(std::size_t entries, const std::string& why) {
    if (!break_ahead_.empty() && break_ahead_at_ <= entries) return;
    break_ahead_ = why + " (read in advance)";
    break_ahead_at_ = entries;
}

std::string ScanSource::missedAhead(std::size_t entries) const {
    return break_ahead_at_ < entries ? break_ahead_ : "";
}

void ScanSource::checkInterruption() const {
    if (!options_.keep_going()) throw Interrupted("interrupted");
}

bool ScanSource::skips(std::size_t entry) {
    const bool is_before = entry < options_.first_entry;
    entries_skipped_ += is_before;
    return is_before;
}

bool ScanSource::isSelected(const std::string& sensor_label) const {
    const auto& labels = options_.sensor_labels;
    return labels.empty() || std::find(labels.begin(), labels.end(), sensor_label) != labels.end();
}

void ScanSource::see(const CObservation& observation) {
    if (!is_levelled_by_file_) horizon_.see(observation);
}

void ScanSource::addIfScan(const CObservation::ConstPtr& observation, const std::string& name,
                           RecordedEntry& entry) {
    if (!observations::isLidarScan(*observation)) return;
    if (!isSelected(observation->sensorLabel)) {
        other_labels_.insert(observation->sensorLabel);
        return;
    }
    labels_.insert(observation->sensorLabel);
    if (labels_.size() > kMostLabels) {
        throw TooManySensors("entry " + std::to_string(entry.number) +
                             ": the recording has more than " + std::to_string(kMostLabels) +
                             " LiDARs by their labels; convert some of them (--sensor-label)");
    }
    const bool are_of_sensor =
        poses_.are_of_sensor || poses_.of_sensors.count(observation->sensorLabel) > 0;
    observations::ScanPose pose =
        observations::scanPoseOf(*observation, poses_.vehicle, horizon_, are_of_sensor);
    if (poses_.vehicles.count(observation->sensorLabel) > 0) pose.attitude_is_of_sensor = true;
    entry.scans.push_back({observation, pose, entry.number, name, nullptr});
    if (recovers_beams_ && observations::isCloud(*observation)) {
        entry.scans.back().beams = beamsOf(observation->sensorLabel);
    }
}

namespace {

namespace fs = std::filesystem;

/// Recordings in a folder, which are read one by one, in the order of their names.
std::vector<fs::path> recordingsIn(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::path& path : base::entriesOf(folder)) {
        const bool is_file = fs::is_regular_file(path);
        const bool is_recording = is_file ? recordings::isBag(path) || sensors::isCapture(path) ||
                                                path.extension() == ".rawlog"
                                          : fs::is_directory(path) && recordings::isBag(path);
        if (is_recording) found.push_back(path);
    }
    return found;
}

bool isScanFolder(const fs::path& folder) {
    std::error_code unreadable;
    const std::vector<fs::path> scans = base::entriesOf(folder / "velodyne", unreadable);
    return std::any_of(scans.begin(), scans.end(),
                       [](const fs::path& file) { return file.extension() == ".bin"; });
}

/// The first folder with scans in a folder, up to two levels deep; empty if there is none. Folders
/// that may not be read are none.
fs::path scansWithin(const fs::path& folder, int depth = 2) {
    std::error_code unreadable;
    for (const fs::path& within : base::entriesOf(folder, unreadable)) {
        if (!fs::is_directory(within, unreadable)) continue;
        if (base::entriesOf(within, unreadable).empty() || unreadable) continue;
        if (isScanFolder(within) || CloudFileSource::hasClouds(within)) {
            return within;
        }
        const fs::path deeper = depth > 1 ? scansWithin(within, depth - 1) : fs::path();
        if (!deeper.empty()) return deeper;
    }
    return {};
}

/// Why a folder is none that is read, and what to read instead.
std::string whyNoFolder(const fs::path& folder) {
    const std::vector<fs::path> recordings = recordingsIn(folder);
    if (recordings.size() == 1) {
        return "is a folder with one recording, which is read by its own name: " +
               recordings[0].string();
    }
    if (!recordings.empty()) {
        return "is a folder with " + std::to_string(recordings.size()) +
               " recordings, which are not read in one go: name one of them, such as " +
               recordings[0].string();
    }
    const fs::path scans = scansWithin(folder);
    return "not a scan folder (no subfolder 'velodyne' with .bin files), and no folder of point "
           "clouds (no .pcd, .ply, .las, .npy or .bin) or with a recording (.rawlog, .pcap, "
           ".bag, .mcap, .db3)" +
           (scans.empty() ? "" : "; there are scans in " + scans.string());
}

}  // namespace

std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                          const SourceOptions& options) {
    if (!std::filesystem::exists(recording)) {
        throw std::runtime_error(recording.string() + ": no such file or folder");
    }
    const bool is_folder = std::filesystem::is_directory(recording);
    if (!is_folder && !std::filesystem::is_regular_file(recording)) {
        throw std::runtime_error(recording.string() +
                                 ": is a pipe or a device; a recording is read more than once, so "
                                 "store it in a file first");
    }
    const bool is_scan_folder = is_folder && isScanFolder(recording);
    const bool has_clouds = is_folder && CloudFileSource::hasClouds(recording);
    // A recording among clouds is one of their other files, which are counted.
    const bool is_bag =
        recordings::isBag(recording) && (!has_clouds || fs::exists(recording / "metadata.yaml"));
    if (is_folder && !is_bag && !is_scan_folder && !has_clouds) {
        throw std::runtime_error(recording.string() + ": " + whyNoFolder(recording));
    }
    const bool is_capture = !is_bag && !is_folder && sensors::isCapture(recording);
    if (!options.calibration.empty() && !is_capture) {
        throw std::runtime_error(recording.string() + ": is no capture (.pcap, .pcapng), so " +
                                 options.calibration.string() +
                                 " is not used; rawlogs have their calibration, and packets of an "
                                 "HDL-64E in bags are not supported");
    }
    if (is_bag) return std::make_unique<BagSource>(recording, options);
    if (!options.topics.empty()) {
        throw std::runtime_error(recording.string() + ": is no ROS recording (.bag, .mcap, " +
                                 ".db3 or its folder), so it has no topic '" +
                                 options.topics.front() + "'");
    }
    if (is_capture) {
        return std::make_unique<CaptureSource>(recording, options);
    }
    if (!options.sensor_json.empty()) {
        const bool are_exchanged = sensors::isCapture(options.sensor_json);
        throw std::runtime_error(
            recording.string() +
            ": is no capture (.pcap, .pcapng) and no ROS recording, so there " +
            "is no sensor that " + options.sensor_json.string() + " could describe" +
            (are_exchanged ? ", which is a capture itself: are the two files exchanged?" : ""));
    }
    if (is_scan_folder) return std::make_unique<ScanFolderSource>(recording, options);
    if (is_folder || recordings::cloudFormatOf(recording) || recordings::hasCloudName(recording)) {
        return std::make_unique<CloudFileSource>(recording, options);
    }
    return std::make_unique<RawlogSource>(recording, options);
}

std::string titleOf(const RecordedScan& scan) {
    std::string name = scan.name.empty() ? scan.observation->sensorLabel : scan.name;
    const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    std::replace_if(name.begin(), name.end(), isControl, '?');
    return "entry " + std::to_string(scan.entry) + " (" + name + ")";
}

}  // namespace hagen::recordings
