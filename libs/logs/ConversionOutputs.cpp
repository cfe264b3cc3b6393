#include "ConversionOutputs.h"

#include <hagen/logs/ScanFolder.h>
#include <hagen/logs/Statistics.h>
#include <hagen/pictures/StagePictures.h>

namespace hagen::logs {

namespace fs = std::filesystem;

namespace {

/// The sensor's tilt on the level vehicle: as in the log, otherwise as in the settings.
Attitude mountOf(const mrpt::obs::CObservation& scan, const observations::Settings& settings) {
    const mrpt::math::TPose3D on_vehicle = scan.sensorPose();
    if (on_vehicle.roll == 0 && on_vehicle.pitch == 0) return settings.mount;
    return {static_cast<float>(on_vehicle.roll), static_cast<float>(on_vehicle.pitch)};
}

}  // namespace

ConversionOutputs::ConversionOutputs(const Conversion& conversion) : conversion_(conversion) {
    const bool overwrite = conversion.overwrite;
    if (!conversion.rawlog.empty()) rawlog_.emplace(conversion.rawlog, overwrite);
    if (!conversion.folder.empty()) {
        folders_.emplace(conversion.folder, kScanFolders, overwrite);
    }
    if (!conversion.clouds.empty()) {
        clouds_.emplace(conversion.clouds, conversion.cloud_format, overwrite);
    }
    if (!conversion.mcap.empty()) mcap_.emplace(conversion.mcap, overwrite);
    if (!conversion.pictures.empty()) {
        pictures_.emplace(conversion.pictures, pictures::kStagePictures, overwrite);
    }
    if (!conversion.octomaps.empty()) {
        map_.emplace(conversion.octomaps, conversion.octomap, overwrite);
    }
    if (!conversion.stats.empty()) {
        stats_.emplace(conversion.stats, base::kFile, overwrite);
    }
}

std::string ConversionOutputs::writeScan(
    const observations::ObservationSegmenter::Output& segmented, const RecordedScan& recorded,
    const observations::Settings& settings) {
    const std::string& sensor_label = recorded.observation->sensorLabel;
    const std::size_t number = scans_[sensor_label]++;
    const std::string own_name = recorded.name.empty() ? scanName(number) : recorded.name;
    if (folders_) {
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
        const double time_s = mrpt::Clock::toDouble(segmented.roi->timestamp);
        writer->second.write(own_name, *segmented.scan, segmented.result->returns,
                             *segmented.sensor, time_s, segmented.pose.sensor_pose,
                             !segmented.pose.sensor_pose || segmented.pose.pose_has_horizon);
    }
    if (clouds_) clouds_->write(own_name, segmented, *recorded.observation);
    if (mcap_) mcap_->write(segmented, *recorded.observation);
    if (pictures_) drawPictures(segmented, recorded);
    return own_name;
}

/// Into a folder named by the entry, so that --from finds it again.
void ConversionOutputs::drawPictures(const observations::ObservationSegmenter::Output& segmented,
                                     const RecordedScan& recorded) {
    const std::string& label = recorded.observation->sensorLabel;
    const bool is_named = !recorded.name.empty();
    const std::string name = is_named ? recorded.name : scanName(recorded.entry);
    fs::path folder = pictures_->folderOf(label) / name;
    while (!fs::create_directory(folder)) folder += "_";  // a second scan in a sensory frame
    const std::string title = conversion_.input.filename().string() + ", " + label +
                              (is_named ? ", scan " : ", entry ") + name;
    pictures::drawStages({*segmented.scan, *segmented.sensor, *segmented.options, *segmented.result,
                          title, conversion_.picture_azimuth_deg},
                         folder);
}

void ConversionOutputs::finish(const ConversionReport& report) {
    for (const auto& [label, writer] : folder_writers_) {
        writer.finish();
        markAsPredictions(folders_->folderOf(label));
    }
    if (mcap_) mcap_->finish();
    if (map_) map_->write();
    if (stats_) writeStatistics(stats_->temporary(), conversion_, report);
}

void ConversionOutputs::commit(const ConversionReport& report) {
    finish(report);
    if (stats_) stats_->commit();
    if (map_) map_->commit();
    if (pictures_) pictures_->commit();
    if (mcap_) mcap_->commit();
    if (clouds_) clouds_->commit();
    if (folders_) folders_->commit();
    if (rawlog_) rawlog_->commit();
}

std::string ConversionOutputs::keepPartial(const ConversionReport& report) {
    finish(report);
    std::string names;
    const auto keep = [&](auto& output) {
        if (output) names += " " + output->keepPartial().string();
    };
    keep(rawlog_);
    keep(folders_);
    keep(clouds_);
    keep(mcap_);
    keep(pictures_);
    if (map_) names += map_->keepPartial();
    keep(stats_);
    return names;
}

}  // namespace hagen::logs
