#include "recordings/BagSource.h"

#include <hagen/recordings/PoseFile.h>
#include <hagen/recordings/Remarks.h>

#include "recordings/ScanObject.h"

namespace hagen::recordings {
namespace {

/// Poses of a bag as a trajectory. Frames of ROS have the z axis up (REP 103).
RawlogSurvey posesOf(const recordings::PoseSeries& series) {
    RawlogSurvey survey;
    survey.source = series.source;
    for (const recordings::RecordedPose& pose : series.poses) {
        survey.trajectory.add(
            recordings::timeOf(pose.time_ns),
            mrpt::poses::CPose3D(mrpt::math::CQuaternionDouble(pose.qw, pose.qx, pose.qy, pose.qz),
                                 pose.x_m, pose.y_m, pose.z_m));
    }
    return survey;
}

}  // namespace

BagSource::BagSource(const std::filesystem::path& bag, const SourceOptions& options)
    : ScanSource(options), file_(bag), survey_(surveyInAdvance()), scans_(openScans()) {}

recordings::BagSurvey BagSource::surveyInAdvance() {
    bool is_interrupted = false;
    recordings::BagSurvey survey = recordings::surveyBag(file_, [&] {
        is_interrupted = !options_.keep_going();
        return !is_interrupted;
    });
    if (is_interrupted) throw Interrupted("interrupted");
    if (!survey.broken_because.empty()) brokeOffAhead(survey.messages, survey.broken_because);
    return survey;
}

std::unique_ptr<recordings::BagScans> BagSource::openScans() const {
    auto scans = std::make_unique<recordings::BagScans>(
        file_, survey_, recordings::BagOptions{options_.topics, options_.sensor_json});
    scans->checkWhileReading([this] { checkInterruption(); });
    return scans;
}

std::optional<RecordedEntry> BagSource::nextEntry() {
    while (scans_read_ <= options_.last_entry) {
        checkInterruption();
        const auto observation = scans_->next();
        is_read_to_end_ = observation == nullptr;
        if (!observation) {
            const std::string missed = missedAhead(scans_->messagesRead() + 1);
            if (!missed.empty()) throw recordings::BrokenBag(missed);
            return std::nullopt;
        }
        if (++seen_ > shown_) ahead_.reset();  // it is rarely needed again, and holds a chunk
        see(*observation);
        if (!observations::isLidarScan(*observation)) continue;
        RecordedEntry entry;
        entry.number = scans_read_++;
        if (skips(entry.number)) continue;
        entry.object = objectOf(observation, options_.folder_objects);
        entry.fraction_read = scans_->fractionRead();
        addIfScan(observation, "", entry);
        return entry;
    }
    const std::string missed = missedAhead(scans_->messagesRead());
    if (!missed.empty()) throw recordings::BrokenBag(missed);
    return std::nullopt;
}

RawlogSurvey BagSource::surveyScans() {
    RawlogSurvey survey;
    const auto ahead = openScans();
    try {
        while (const auto scan = ahead->next()) {
            checkInterruption();
            if (!observations::isLidarScan(*scan)) continue;
            survey.scans[scan->sensorLabel].push_back(
                {scan->timestamp, mrpt::poses::CPose3D(scan->sensorPose())});
        }
    } catch (const recordings::BrokenBag& e) {
        survey.is_whole = false;
        brokeOffAhead(ahead->messagesRead(), e.what());
    }
    return survey;
}

LogPoses BagSource::readPoses(const std::filesystem::path& file) {
    if (file.empty()) {
        const recordings::PoseSeries* const poses = scans_->plan().poses;
        LogPoses found = posesOfRawlog(poses == nullptr ? RawlogSurvey() : posesOf(*poses), file);
        for (const auto& [topic, sensor] : scans_->plan().sensors) {
            if (sensor.has_its_own_poses) found.of_sensors.insert(sensor.label);
            if (sensor.is_vehicle) found.vehicles.insert(sensor.label);
        }
        return found;
    }
    if (kindOfPoseFile(file) == PoseFileKind::Tum) return posesOfRawlog(RawlogSurvey(), file);
    const auto isKept = [this](const std::string& label) { return isSelected(label); };
    return posesOfRawlog(withScansOf(surveyScans(), isKept), file);
}

bool BagSource::showClouds(observations::CloudSensors& sensors) {
    try {
        if (!ahead_) {
            ahead_ = openScans();
            for (std::size_t i = 0; i < shown_; ++i) ahead_->next();
        }
        ++shown_;
        const auto observation = ahead_->next();
        if (!observation) return false;
        sensors.see(*observation);
        return true;
    } catch (const recordings::BrokenBag& e) {
        brokeOffAhead(ahead_ ? ahead_->messagesRead() : 0, e.what());
        return false;
    }
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> BagSource::scanTimes() {
    return scanTimesOf(surveyScans());
}

std::vector<std::string> BagSource::remarks() const {
    std::vector<std::string> remarks = scans_->remarks();
    if (!is_read_to_end_ && scans_read_ > options_.last_entry) {
        for (std::string& remark : remarks) remark += " (up to the last entry converted)";
    }
    return remarks;
}

}  // namespace hagen::recordings
