#include "recordings/folders/ScanFolderSource.h"

#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/CloudFile.h>

namespace hagen::recordings {

constexpr double kDefaultScanPeriod_s = 0.1;  // for folders without times.txt

ScanFolderSource::ScanFolderSource(const std::filesystem::path& folder,
                                   const SourceOptions& options)
    : ScanSource(options), folder_(folder), times_s_(folder_.times()) {
    for (std::size_t i = times_s_.size(); i < folder_.size(); ++i) {
        times_s_.push_back(kDefaultScanPeriod_s * static_cast<double>(i));
    }
}

std::optional<RecordedEntry> ScanFolderSource::nextEntry() {
    while (next_ < folder_.size() && next_ <= options_.last_entry) {
        const std::size_t i = next_++;
        checkInterruption();
        if (skips(i)) continue;
        has_rings_ |= readScan(folder_.scanFile(i), scan_) == 5;
        const auto time = mrpt::Clock::fromDouble(times_s_[i]);
        RecordedEntry entry;
        entry.number = i;
        entry.fraction_read = static_cast<double>(i + 1) / static_cast<double>(folder_.size());
        if (options_.folder_objects) {
            entry.object =
                observations::observationOf(scan_, kFolderLabel, time, *options_.folder_objects);
        }
        addIfScan(observations::observationOf(scan_, kFolderLabel, time), folder_.name(i), entry);
        return entry;
    }
    const std::string missed = missedAhead(next_);
    if (!missed.empty()) throw BrokenScan(missed);
    return std::nullopt;
}

LogPoses ScanFolderSource::readPoses(const std::filesystem::path& file) {
    return posesOfScanFolder(folder_, times_s_, file);
}

bool ScanFolderSource::showClouds(observations::CloudSensors& sensors) {
    if (next_shown_ >= folder_.size()) return false;
    const std::size_t i = next_shown_++;
    Scan cloud;
    try {
        readScan(folder_.scanFile(i), cloud);
    } catch (const BrokenScan& e) {
        if (i >= options_.first_entry) brokeOffAhead(i, e.what());
        return true;
    }
    sensors.see(kFolderLabel, cloud);
    return true;
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> ScanFolderSource::scanTimes() {
    std::vector<mrpt::Clock::time_point> times;
    for (const double time_s : times_s_) times.push_back(mrpt::Clock::fromDouble(time_s));
    return {{kFolderLabel, times}};
}

std::vector<std::string> ScanFolderSource::remarks() const {
    std::vector<std::string> remarks;
    const std::string scans = (folder_.path() / "velodyne").string();
    if (has_rings_) {
        remarks.push_back(
            "the rings of its points (nuScenes) are not used; as a folder of point clouds, " +
            scans + ", they are");
    }
    const std::vector<std::string>& others = folder_.otherFiles();
    if (!others.empty()) {
        remarks.push_back(std::to_string(others.size()) + " of the entries in " + scans +
                          " do not end in .bin, such as " + others.front() + ": they are not read");
    }
    return remarks;
}

Settings ScanFolderSource::settingsFor(const Settings& settings) const {
    Settings merged = settings;
    if (std::filesystem::exists(folder_.sensorFile())) {
        mergeSettings(folder_.sensorFile(), merged, SettingsOrigin::Recording);
    }
    return merged;
}

}  // namespace hagen::recordings
