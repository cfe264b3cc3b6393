#include <hagen/recordings/ScanSource.h>

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/BrokenRecording.h>
#include <hagen/sensors/CaptureFile.h>

#include <algorithm>
#include <iterator>

#include "base/Folder.h"
#include "recordings/Sources.h"
#include "recordings/bags/BagFile.h"
#include "recordings/clouds/CloudFile.h"

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

const SharedBeams& ScanSource::beamsOf(const std::string& sensor_label) {
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
    break_ahead_ = why + " (found while reading ahead)";
    break_ahead_at_ = entries;
}

std::string ScanSource::missedAhead(std::size_t entries) const {
    return break_ahead_at_ < entries ? break_ahead_ : "";
}

std::optional<RecordedEntry> ScanSource::endAfter(std::size_t entries) const {
    const std::string missed = missedAhead(entries);
    if (!missed.empty()) throw BrokenRecording(missed);
    return std::nullopt;
}

void ScanSource::checkInterruption() const {
    if (!options_.keep_going()) throw Interrupted("interrupted");
}

bool ScanSource::skips(std::size_t entry) {
    const bool is_before = entry < options_.first_scan;
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
    if (options_.packet) {
        observations::forEachPacket(*observation, [&](const sensors::Datagram& datagram) {
            options_.packet(observation->sensorLabel, datagram);
        });
    }
    if (labels_.size() > kMaxLabels) {
        throw BrokenRecording(recording_.string() + ": scan " + std::to_string(entry.number) +
                              ": the recording has more than " + std::to_string(kMaxLabels) +
                              " LiDAR labels; select some of them (--sensor-label)");
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

enum class RecordingKind { Rawlog, Capture, Bag, ScanFolder, Clouds };

namespace fs = std::filesystem;

/// Recordings in a folder, sorted by name.
std::vector<fs::path> recordingsIn(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::path& path : base::entriesOf(folder)) {
        const bool is_other_file = fs::is_regular_file(path) &&
                                   (sensors::isCapture(path) || path.extension() == ".rawlog");
        const bool may_be_bag = fs::is_regular_file(path) || fs::is_directory(path);
        if (is_other_file || (may_be_bag && isBag(path))) found.push_back(path);
    }
    return found;
}

bool isScanFolder(const fs::path& folder) {
    std::error_code unreadable;
    const std::vector<fs::path> scans = base::entriesOf(folder / "velodyne", unreadable);
    return std::any_of(scans.begin(), scans.end(),
                       [](const fs::path& file) { return file.extension() == ".bin"; });
}

bool hasClouds(const fs::path& folder) {
    const std::vector<fs::path> entries = base::entriesOf(folder);
    return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
        return !fs::is_directory(entry) && hasCloudName(entry);
    });
}

/// The first subfolder with scans, up to two levels deep; empty if there is none. Skips folders
/// without read permission.
fs::path scansWithin(const fs::path& folder, int depth = 2) {
    std::error_code unreadable;
    for (const fs::path& within : base::entriesOf(folder, unreadable)) {
        if (!fs::is_directory(within, unreadable)) continue;
        if (base::entriesOf(within, unreadable).empty() || unreadable) continue;
        if (isScanFolder(within) || hasClouds(within)) return within;
        const fs::path deeper = depth > 1 ? scansWithin(within, depth - 1) : fs::path();
        if (!deeper.empty()) return deeper;
    }
    return {};
}

/// Why a folder is not a recording, with a hint on what to pass instead.
std::string whyNoRecording(const fs::path& folder) {
    const std::vector<fs::path> recordings = recordingsIn(folder);
    if (!recordings.empty()) {
        return "is a folder with " + std::to_string(recordings.size()) +
               (recordings.size() == 1 ? " recording; pass it: "
                                       : " recordings; pass one of them: ") +
               recordings[0].string();
    }
    const fs::path scans = scansWithin(folder);
    return "not a scan folder (no subfolder 'velodyne' with .bin files), not a folder of point "
           "clouds (.pcd, .ply, .las, .npy, .bin), and contains no recordings "
           "(.rawlog, .pcap, .bag, .mcap, .db3)" +
           (scans.empty() ? "" : "; there are scans in " + scans.string() + ": pass such a folder");
}

RecordingKind kindOfFolder(const fs::path& folder) {
    const bool has_clouds = hasClouds(folder);
    // Ignore a bag beside clouds, unless it has metadata.
    if (isBag(folder) && (!has_clouds || fs::exists(folder / "metadata.yaml"))) {
        return RecordingKind::Bag;
    }
    if (isScanFolder(folder)) return RecordingKind::ScanFolder;
    if (has_clouds) return RecordingKind::Clouds;
    throw std::runtime_error(folder.string() + ": " + whyNoRecording(folder));
}

/// Detects the kind of a file by its content, and of a folder by its files. Unknown files are
/// treated as rawlogs, whose reader reports the likely format. Throws std::runtime_error naming the
/// path if it does not exist, is a pipe or a device, or is a folder of unknown kind.
RecordingKind detectKind(const fs::path& recording) {
    if (!fs::exists(recording)) {
        throw std::runtime_error(recording.string() + ": no such file or folder");
    }
    if (fs::is_directory(recording)) return kindOfFolder(recording);
    if (!fs::is_regular_file(recording)) {
        throw std::runtime_error(recording.string() +
                                 ": is a pipe or a device; save its content to a file first, "
                                 "because recordings are read more than once");
    }
    if (isBag(recording)) return RecordingKind::Bag;
    if (sensors::isCapture(recording)) return RecordingKind::Capture;
    const bool is_cloud = cloudFormatOf(recording).has_value() || hasCloudName(recording);
    return is_cloud ? RecordingKind::Clouds : RecordingKind::Rawlog;
}

/// Throws std::runtime_error if an option does not apply to this kind of recording.
void checkOptions(const std::string& recording, RecordingKind kind, const SourceOptions& options) {
    const bool is_capture = kind == RecordingKind::Capture, is_bag = kind == RecordingKind::Bag;
    if (!options.calibration.empty() && !is_capture) {
        throw std::runtime_error(recording + ": is not a capture (.pcap, .pcapng), so " +
                                 options.calibration.string() +
                                 " does not apply; rawlogs contain their calibration, and "
                                 "HDL-64E packets in bags are not supported");
    }
    if (!options.topics.empty() && !is_bag) {
        throw std::runtime_error(recording +
                                 ": is not a ROS recording (.bag, .mcap, .db3 or its "
                                 "folder), so it has no topic '" +
                                 options.topics.front() + "'");
    }
    if (!options.bin_fields.empty() && kind != RecordingKind::Clouds &&
        kind != RecordingKind::ScanFolder) {
        throw std::runtime_error(recording +
                                 ": is not a .bin file or a folder of them, so "
                                 "--bin-fields does not apply");
    }
    if (!options.sensor_json.empty() && !is_capture && !is_bag) {
        const bool are_exchanged = sensors::isCapture(options.sensor_json);
        throw std::runtime_error(
            recording +
            ": is neither a capture (.pcap, .pcapng) nor a ROS recording, so the metadata " +
            options.sensor_json.string() + " do not apply" +
            (are_exchanged ? ", which is a capture: are the two files swapped?" : ""));
    }
}

std::unique_ptr<ScanSource> openKind(const std::filesystem::path& recording, RecordingKind kind,
                                     const SourceOptions& options) {
    switch (kind) {
        case RecordingKind::Capture:
            return openCaptureScans(recording, options);
        case RecordingKind::Bag:
            return openBagScans(recording, options);
        case RecordingKind::ScanFolder:
            return openScanFolder(recording, options);
        case RecordingKind::Clouds:
            return openClouds(recording, options);
        case RecordingKind::Rawlog:
            break;
    }
    return openRawlog(recording, options);
}

}  // namespace

std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                          const SourceOptions& options) {
    const RecordingKind kind = detectKind(recording);
    checkOptions(recording.string(), kind, options);
    auto source = openKind(recording, kind, options);
    source->recording_ = recording;
    return source;
}

std::string titleOf(const RecordedScan& scan) {
    std::string name = scan.name.empty() ? scan.observation->sensorLabel : scan.name;
    const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    std::replace_if(name.begin(), name.end(), isControl, '?');
    return "scan " + std::to_string(scan.entry) + " (" + name + ")";
}

}  // namespace hagen::recordings
