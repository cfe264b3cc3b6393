#include "recordings/rawlogs/RawlogSource.h"

#include <hagen/mrpt/Results.h>
#include <hagen/recordings/PoseFile.h>

#include <memory>
#include <utility>

#include "recordings/ScanObject.h"

namespace hagen::recordings {
namespace {

/// "CObservationImage" for mrpt::obs::CObservationImage.
std::string classOf(const mrpt::rtti::CObject& object) {
    const std::string name = object.GetRuntimeClass()->className;
    const std::size_t colons = name.rfind("::");
    return colons == std::string::npos ? name : name.substr(colons + 2);
}

}  // namespace

RawlogSource::RawlogSource(const std::filesystem::path& rawlog, const SourceOptions& options)
    : ScanSource(options), rawlog_(rawlog), reader_(rawlog) {}

std::optional<RecordedEntry> RawlogSource::nextEntry() {
    while (reader_.entries() <= options_.last_entry) {
        RecordedEntry entry;
        entry.number = reader_.entries();
        checkInterruption();
        entry.object = reader_.next();
        if (!entry.object) {
            const std::string missed = missedAhead(reader_.entries() + 1);
            if (!missed.empty()) throw BrokenRawlog(missed);
            return std::nullopt;
        }
        const bool is_skipped = skips(entry.number);
        const std::size_t nulls = takeOutNulls(entry.object);
        if (!is_skipped) null_objects_ += nulls;
        // Skipped entries may provide the attitude of the first scan.
        const auto all = observationsOf(entry.object);
        for (const auto& observation : all) see(*observation);
        if (is_skipped) continue;
        if (all.empty()) ++has_[classOf(*entry.object)];
        for (const auto& observation : all) {
            has_scans_ = has_scans_ || observations::isLidarScan(*observation);
            const bool is_result = observations::isResult(*observation);
            ++has_[is_result ? "results of an earlier run" : classOf(*observation)];
            addIfScan(observation, "", entry);
        }
        entry.fraction_read = reader_.fractionRead();
        return entry;
    }
    const std::string missed = missedAhead(reader_.entries());
    if (!missed.empty()) throw BrokenRawlog(missed);
    return std::nullopt;
}

std::vector<std::string> RawlogSource::remarks() const {
    std::vector<std::string> remarks;
    if (null_objects_ > 0) {
        remarks.push_back("its sensory frames have " + std::to_string(null_objects_) +
                          " null objects, which MRPT cannot write: they are left out");
    }
    if (poses_not_finite_ > 0) {
        remarks.push_back("poses that are not finite are left out: " +
                          std::to_string(poses_not_finite_));
    }
    if (has_scans_ || has_.empty()) return remarks;
    std::string found;
    for (const auto& [name, count] : has_) {
        found += (found.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    }
    remarks.push_back(
        "no converted entry has a LiDAR scan (CObservationVelodyneScan, "
        "CObservationRotatingScan, CObservationPointCloud, CObservation3DRangeScan); they have " +
        found);
    return remarks;
}

const RawlogSurvey& RawlogSource::survey() {
    if (survey_) return *survey_;
    bool is_interrupted = false;
    RawlogSurvey survey = surveyRawlog(rawlog_, [&] {
        is_interrupted = !options_.keep_going();
        return !is_interrupted;
    });
    if (is_interrupted) throw Interrupted("interrupted");
    if (!survey.break_found.empty()) brokeOffAhead(survey.entries, survey.break_found);
    survey_ = std::move(survey);
    return *survey_;
}

LogPoses RawlogSource::readPoses(const std::filesystem::path& file) {
    // Poses with times do not depend on the log, which need not be read in advance.
    if (!file.empty() && kindOfPoseFile(file) == PoseFileKind::Tum) {
        return posesOfRawlog(RawlogSurvey(), file);
    }
    survey();
    poses_not_finite_ = survey_->not_finite;
    RawlogSurvey all = std::move(*survey_);  // a long trajectory is not kept twice
    survey_.reset();
    const auto isKept = [this](const std::string& label) { return isSelected(label); };
    return posesOfRawlog(withScansOf(std::move(all), isKept), file);
}

bool RawlogSource::showClouds(observations::CloudSensors& sensors) {
    if (!ahead_) ahead_ = std::make_unique<RawlogReader>(rawlog_);
    try {
        const auto entry = ahead_->next();
        if (!entry) return false;
        for (const auto& observation : observationsOf(entry)) sensors.see(*observation);
        return true;
    } catch (const BrokenRawlog& e) {
        brokeOffAhead(ahead_->entries(), e.what());
        return false;
    }
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> RawlogSource::scanTimes() {
    return scanTimesOf(survey());
}

}  // namespace hagen::recordings
