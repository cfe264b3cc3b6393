#include <hagen/logs/ScanSource.h>

#include <hagen/bags/BagFile.h>
#include <hagen/captures/CaptureFile.h>
#include <hagen/clouds/CloudFile.h>
#include <algorithm>

#include "BagSource.h"
#include "CaptureSource.h"
#include "CloudFileSource.h"
#include "RawlogSource.h"
#include "ScanFolderSource.h"

namespace hagen::logs {

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

observations::Settings ScanSource::useSettings(const observations::Settings& settings) {
    observations::Settings merged = settingsFor(settings);
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

observations::Settings ScanSource::settingsFor(const observations::Settings& settings) const {
    return settings;
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
    entry.scans.push_back({observation,
                           observations::scanPoseOf(*observation, poses_.vehicle, horizon_),
                           entry.number, name, nullptr});
    if (recovers_beams_ && observations::isCloud(*observation)) {
        entry.scans.back().beams = beamsOf(observation->sensorLabel);
    }
}

std::unique_ptr<ScanSource> openRecording(const std::filesystem::path& recording,
                                          const SourceOptions& options) {
    if (!std::filesystem::exists(recording)) {
        throw std::runtime_error(recording.string() + ": no such file or folder");
    }
    const bool is_folder = std::filesystem::is_directory(recording);
    const bool is_bag = bags::isBag(recording);
    const bool is_capture = !is_bag && !is_folder && captures::isCapture(recording);
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
        throw std::runtime_error(
            recording.string() +
            ": is no capture (.pcap, .pcapng) and no ROS recording, so there " +
            "is no sensor that " + options.sensor_json.string() + " could describe");
    }
    if (is_folder) {
        if (std::filesystem::is_directory(recording / "velodyne")) {
            return std::make_unique<ScanFolderSource>(recording, options);
        }
        if (CloudFileSource::hasClouds(recording)) {
            return std::make_unique<CloudFileSource>(recording, options);
        }
        throw std::runtime_error(recording.string() +
                                 ": not a scan folder (no subfolder 'velodyne'), and no folder of "
                                 "point clouds (no .pcd, .ply, .las, .npy or .bin)");
    }
    if (clouds::cloudFormatOf(recording) || clouds::hasCloudName(recording)) {
        return std::make_unique<CloudFileSource>(recording, options);
    }
    return std::make_unique<RawlogSource>(recording, options);
}

std::string titleOf(const RecordedScan& scan) {
    return "entry " + std::to_string(scan.entry) + " (" +
           (scan.name.empty() ? scan.observation->sensorLabel : scan.name) + ")";
}

}  // namespace hagen::logs
