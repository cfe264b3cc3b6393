#include "convert/ConversionOutputs.h"

#include <hagen/mrpt/TimeStamp.h>
#include <hagen/recordings/ScanFolder.h>
#include "base/Folder.h"
#include "base/MemoryLimit.h"
#include "convert/ConversionStatistics.h"
#include "convert/pictures/StagePictures.h"
#include "filter/image/Posture.h"
#include "mrpt/Mount.h"

#include <algorithm>
#include <iostream>
#include <new>

namespace hagen::convert {

namespace fs = std::filesystem;

namespace {

/// The sensor's tilt on the level vehicle, from the log or otherwise from the settings.
Attitude mountOf(const mrpt::obs::CObservation& scan, const Settings& settings) {
    const mrpt::math::TPose3D on_vehicle = scan.sensorPose();
    return observations::mountOf(
        {static_cast<float>(on_vehicle.roll), static_cast<float>(on_vehicle.pitch)},
        settings.mount);
}

const fs::path kStandardOutput = "-";

std::string textOfNames(const fs::path& name) { return name.string(); }
std::string textOfNames(const std::string& names) { return names; }

}  // namespace

std::vector<fs::path> outputsOf(const Conversion& conversion) {
    std::vector<fs::path> outputs{conversion.rawlog, conversion.folder,   conversion.clouds,
                                  conversion.mcap,   conversion.pictures, conversion.view};
    if (conversion.stats != kStandardOutput) outputs.push_back(conversion.stats);
    outputs.insert(outputs.end(), conversion.octomaps.begin(), conversion.octomaps.end());
    outputs.erase(std::remove(outputs.begin(), outputs.end(), fs::path()), outputs.end());
    return outputs;
}

ConversionOutputs::ConversionOutputs(const Conversion& conversion)
    : conversion_(conversion),
      paths_{conversion.rawlog,
             conversion.folder,
             conversion.clouds,
             conversion.mcap,
             conversion.pictures,
             conversion.view,
             conversion.octomaps.empty() ? fs::path() : conversion.octomaps.front(),
             conversion.stats} {
    const bool overwrite = conversion.overwrite;
    if (!conversion.rawlog.empty()) rawlog_.emplace(conversion.rawlog, overwrite);
    if (!conversion.folder.empty()) {
        folders_.emplace(conversion.folder, recordings::kScanFolders, overwrite);
    }
    if (!conversion.clouds.empty()) {
        clouds_.emplace(conversion.clouds, conversion.cloud_format, overwrite);
    }
    if (!conversion.mcap.empty()) mcap_.emplace(conversion.mcap, overwrite);
    if (!conversion.pictures.empty()) {
        pictures_.emplace(conversion.pictures, kStagePictures, overwrite);
    }
    if (!conversion.view.empty()) {
        view_.emplace(conversion.view, conversion.view_every, overwrite);
    }
    if (!conversion.octomaps.empty()) {
        map_.emplace(conversion.octomaps, conversion.octomap, overwrite);
    }
    if (!conversion.stats.empty() && conversion.stats != kStandardOutput) {
        stats_.emplace(conversion.stats, base::kFile, overwrite);
    }
}

// Runs a step of a part, unless the part has failed. Members are packed on several threads; all
// other steps of a part run on one thread at a time.
template <class Step>
void ConversionOutputs::attempt(Part part, Step step) {
    if (is_given_up_[part]) return;
    try {
        step();
    } catch (const std::exception& e) {
        giveUp(part, e);
    }
}

/// Keeps the first reason.
void ConversionOutputs::giveUp(Part part, const std::exception& why) {
    const std::lock_guard lock(why_mutex_);
    if (is_given_up_[part]) return;
    is_given_up_[part] = true;
    const bool is_memory = dynamic_cast<const std::bad_alloc*>(&why) != nullptr;
    why_[part] = is_memory ? paths_[part].string() + ": " + base::outOfMemory() +
                                 (part == kMap ? "; or use larger voxels" : "")
                           : base::withOutputNames(why.what());
}

template <class Do>
void ConversionOutputs::forEach(Do act) {
    if (rawlog_) act(kRawlog, *rawlog_);
    if (folders_) act(kFolders, *folders_);
    if (clouds_) act(kClouds, *clouds_);
    if (mcap_) act(kMcap, *mcap_);
    if (pictures_) act(kPictures, *pictures_);
    if (view_) act(kView, *view_);
    if (map_) act(kMap, *map_);
    if (stats_) act(kStats, *stats_);
}

bool ConversionOutputs::hasAny() const {
    bool is_asked_for = false;
    for (std::size_t part = 0; part < kParts; ++part) {
        if (paths_[part].empty()) continue;
        if (!is_given_up_[part]) return true;
        is_asked_for = true;
    }
    return !is_asked_for;
}

void ConversionOutputs::pack(const Bytes& member, Bytes& packed) {
    attempt(kRawlog, [&] { packGzipMember(member, packed); });
}

void ConversionOutputs::writeMember(const Bytes& packed) {
    attempt(kRawlog, [&] { rawlog_->writeMember(packed); });
}

void ConversionOutputs::insertIntoMap(const observations::MappedScan& scan) {
    if (is_given_up_[kMap]) return;
    try {
        map_->insert(scan);
    } catch (const observations::MapFull& e) {
        giveUpMap(paths_[kMap].string() + ": " + e.what());
    } catch (const std::bad_alloc& e) {
        giveUp(kMap, e);
    }
}

void ConversionOutputs::writeToFolder(const observations::ObservationSegmenter::Output& segmented,
                                      const recordings::RecordedScan& recorded,
                                      const std::string& name, const Settings& settings) {
    const std::string& sensor_label = recorded.observation->sensorLabel;
    auto writer = folder_writers_.find(sensor_label);
    if (writer == folder_writers_.end()) {
        std::optional<GivenLimits> unnamed;
        if (segmented.recovered || segmented.is_sensor_assumed) {
            unnamed = {settings.sensor.min_range_m, settings.sensor.max_range_m};
        }
        ScanFolderWriter to_folder(folders_->folderOf(sensor_label),
                                   mountOf(*segmented.roi, settings), unnamed);
        writer = folder_writers_.emplace(sensor_label, std::move(to_folder)).first;
    }
    const double time_s = observations::secondsOf(segmented.roi->timestamp);
    writer->second.write(name, *segmented.scan, segmented.result->returns, *segmented.sensor,
                         time_s, segmented.pose.sensor_pose,
                         !segmented.pose.sensor_pose || segmented.pose.pose_has_horizon);
}

std::string ConversionOutputs::writeScan(
    const observations::ObservationSegmenter::Output& segmented,
    const recordings::RecordedScan& recorded, const Settings& settings) {
    const std::size_t number = scans_[recorded.observation->sensorLabel]++;
    const std::string own_name = recorded.name.empty() ? scanName(number) : recorded.name;
    if (folders_) {
        attempt(kFolders, [&] { writeToFolder(segmented, recorded, own_name, settings); });
    }
    if (clouds_) {
        attempt(kClouds, [&] { clouds_->write(own_name, segmented, *recorded.observation); });
    }
    if (mcap_) attempt(kMcap, [&] { mcap_->write(segmented, *recorded.observation); });
    if (pictures_) attempt(kPictures, [&] { drawPictures(segmented, recorded); });
    return own_name;
}

void ConversionOutputs::show(const ScanReport& report,
                             const observations::ObservationSegmenter::Output& segmented) {
    if (view_) attempt(kView, [&] { view_->write(report, segmented); });
}

/// The folder is named after the entry, for use with --from.
void ConversionOutputs::drawPictures(const observations::ObservationSegmenter::Output& segmented,
                                     const recordings::RecordedScan& recorded) {
    const std::string& label = recorded.observation->sensorLabel;
    const std::string name = recorded.name.empty() ? scanName(recorded.entry) : recorded.name;
    fs::path folder = pictures_->folderOf(label) / name;
    while (!fs::create_directory(folder)) folder += "_";  // used by another scan
    const std::string title = base::lastNameOf(conversion_.input) + ", " + label + ", scan " + name;
    // The view in which the filter processes a sensor that is not upright: image rows differ from
    // the sensor's.
    const std::optional<Attitude>& attitude = segmented.pose.attitude;
    const Posture posture = postureOf(attitude, *segmented.sensor);
    const SensorModel sensor = sensorIn(posture, *segmented.sensor);
    Scan turned;
    if (posture != Posture::Upright) turnScan(*segmented.scan, posture, attitude, sensor, turned);
    const Scan& shown = posture == Posture::Upright ? *segmented.scan : turned;
    drawStages({shown, sensor, *segmented.options, *segmented.result, title,
                conversion_.picture_azimuth_deg},
               folder);
}

void ConversionOutputs::finishFolders() {
    if (are_folders_finished_) return;
    for (const auto& [label, writer] : folder_writers_) {
        writer.finish();
        recordings::markAsPredictions(folders_->folderOf(label));
    }
    are_folders_finished_ = true;
}

void ConversionOutputs::finish(const ConversionReport& report) {
    attempt(kFolders, [&] { finishFolders(); });
    if (mcap_) {
        attempt(kMcap, [&] {
            mcap_->finish();
            is_mcap_finished_ = true;
        });
    }
    if (map_) attempt(kMap, [&] { map_->write(); });
    if (view_) attempt(kView, [&] { view_->finish(conversion_, report); });
    if (!conversion_.stats.empty()) {
        attempt(kStats, [&] {
            if (stats_) {
                writeConversionStatistics(stats_->temporary(), conversion_, report);
            } else {
                printConversionStatistics(std::cout, conversion_, report);
            }
        });
    }
}

/// Whether an aborted output contains complete parts (members of a rawlog, scans, clouds).
bool ConversionOutputs::hasWholeParts(Part part) const {
    if (part == kFolders) {
        return std::any_of(folder_writers_.begin(), folder_writers_.end(),
                           [](const auto& writer) { return writer.second.scans() > 0; });
    }
    return part == kRawlog || (part == kMcap && is_mcap_finished_) ||
           (part == kClouds && clouds_->files() > 0);
}

/// Lists the failed outputs, the reasons, and the parts that are kept.
std::string ConversionOutputs::whatFailed() {
    std::string text;
    forEach([&](Part part, auto& output) {
        if (!is_given_up_[part]) return;
        text += (text.empty() ? "" : "; ") + why_[part];
        if (!hasWholeParts(part)) return;
        try {
            if (part == kFolders) finishFolders();
            text += "; the completed part is in " + textOfNames(output.keepPartial());
        } catch (const std::exception&) {
            text += "; no part is kept";
        }
    });
    return text;
}

void ConversionOutputs::commit(const ConversionReport& report) {
    finish(report);
    forEach([&](Part part, auto& output) { attempt(part, [&] { output.commit(); }); });
    const std::string failed = whatFailed();
    if (!failed.empty()) throw std::runtime_error(failed);
}

std::string ConversionOutputs::keepPartial(const ConversionReport& report) {
    finish(report);
    std::string names;
    forEach([&](Part part, auto& output) {
        if (!is_given_up_[part])
            attempt(part, [&] { names += " " + textOfNames(output.keepPartial()); });
    });
    const std::string failed = whatFailed();
    return names + (failed.empty() ? "" : "; " + failed);
}

}  // namespace hagen::convert
