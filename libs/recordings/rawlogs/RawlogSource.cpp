#include <hagen/recordings/BrokenRecording.h>
#include <hagen/recordings/RawlogReader.h>
#include "mrpt/Results.h"
#include "recordings/PoseFile.h"
#include "recordings/Remarks.h"

#include <algorithm>
#include <utility>

#include "recordings/ScanObject.h"
#include "recordings/Sources.h"

namespace hagen::recordings {
namespace {

/// Class name without namespace of an object without scan, and what it lacks if it could have one.
std::string classOf(const mrpt::rtti::CObject& object) {
    const std::string full = object.GetRuntimeClass()->className;
    const std::string name = full.substr(full.rfind(':') + 1);  // npos + 1 is 0
    if (name == "CObservationRotatingScan") return name + " of a single row";
    return name == "CObservation3DRangeScan" ? name + " without points or ranges" : name;
}

class RawlogSource : public ScanSource {
 public:
    RawlogSource(const std::filesystem::path& rawlog, const SourceOptions& options)
        : ScanSource(options), rawlog_(rawlog), reader_(rawlog) {}

    std::optional<RecordedEntry> nextEntry() override {
        while (scans_read_ <= options_.last_scan) {
            RecordedEntry entry;
            entry.number = scans_read_;
            checkInterruption();
            entry.object = reader_.next();
            if (!entry.object) return endAfter(reader_.entries() + 1);
            const bool is_skipped = skips(entry.number);
            const std::size_t nulls = takeOutNulls(entry.object);
            // Skipped entries may contain the attitude for the first scan.
            const auto all = observationsOf(entry.object);
            for (const auto& observation : all) see(*observation);
            scans_read_ += std::any_of(all.begin(), all.end(), [](const auto& observation) {
                return observations::isLidarScan(*observation);
            });
            if (is_skipped) continue;
            null_objects_ += nulls;
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
        return endAfter(reader_.entries());
    }

    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override {
        return scanTimesOf(survey());
    }
    std::size_t scansKnown() const override { return scans_read_; }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        if (null_objects_ > 0) {
            remarks.push_back("dropped " + counted(null_objects_, "null object") +
                              " from sensory frames, because MRPT cannot write null objects");
        }
        if (poses_not_finite_ > 0) {
            remarks.push_back("skipped " + counted(poses_not_finite_, "non-finite pose"));
        }
        if (has_scans_ || has_.empty()) return remarks;
        std::string found;
        for (const auto& [name, count] : has_) {
            found += (found.empty() ? "" : ", ") + std::to_string(count) + " " + name;
        }
        remarks.push_back(
            "no converted entry has a LiDAR scan (CObservationVelodyneScan, "
            "CObservationRotatingScan, CObservationPointCloud, CObservation3DRangeScan); they "
            "have " +
            found);
        return remarks;
    }

 private:
    const RawlogSurvey& survey() {
        if (survey_) return *survey_;
        bool is_interrupted = false;
        RawlogSurvey survey = surveyRawlog(rawlog_, [&] {
            is_interrupted = !options_.keep_going();
            return !is_interrupted;
        });
        if (is_interrupted) throw Interrupted("interrupted");
        if (!survey.break_found.empty()) brokeOffAhead(survey.entries, survey.break_found);
        return survey_.emplace(std::move(survey));
    }

    LogPoses readPoses(const std::filesystem::path& file) override {
        // Poses with times do not require a survey.
        if (!file.empty() && kindOfPoseFile(file) == PoseFileKind::Tum) {
            return posesOfRawlog(RawlogSurvey(), file);
        }
        poses_not_finite_ = survey().not_finite;
        RawlogSurvey all = std::move(*survey_);  // avoids copying a long trajectory
        survey_.reset();
        const auto isKept = [this](const std::string& label) { return isSelected(label); };
        return posesOfRawlog(withScansOf(std::move(all), isKept), file);
    }

    bool showClouds(CloudSensors& sensors) override {
        if (!ahead_) ahead_ = std::make_unique<RawlogReader>(rawlog_);
        try {
            const auto entry = ahead_->next();
            if (!entry) return false;
            for (const auto& observation : observationsOf(entry))
                observations::showCloud(*observation, sensors);
            return true;
        } catch (const BrokenRecording& e) {
            brokeOffAhead(ahead_->entries(), e.what());
            return false;
        }
    }

    std::filesystem::path rawlog_;
    RawlogReader reader_;
    std::unique_ptr<RawlogReader> ahead_;  ///< for showClouds(), created on demand
    std::optional<RawlogSurvey> survey_;
    std::size_t scans_read_ = 0;  ///< entries with scans
    // Counts over the selected entries:
    std::size_t null_objects_ = 0, poses_not_finite_ = 0;
    bool has_scans_ = false;
    std::map<std::string, std::size_t> has_;  ///< number of objects by class
};

}  // namespace

std::unique_ptr<ScanSource> openRawlog(const std::filesystem::path& rawlog,
                                       const SourceOptions& options) {
    return std::make_unique<RawlogSource>(rawlog, options);
}

}  // namespace hagen::recordings
