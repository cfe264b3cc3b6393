#include "recordings/PoseFile.h"
#include "recordings/ScanObject.h"
#include "recordings/Sources.h"
#include "recordings/SweepObservation.h"
#include "sensors/captures/LidarCapture.h"

namespace hagen::recordings {
namespace {

class CaptureSource : public ScanSource {
 public:
    CaptureSource(const std::filesystem::path& capture, const SourceOptions& options)
        : ScanSource(options),
          file_(capture),
          capture_(sensors::openCapture(capture, options.sensor_json, options.calibration,
                                        [this] { checkInterruption(); })) {}

    std::optional<RecordedEntry> nextEntry() override {
        while (turns_ <= options_.last_scan) {
            checkInterruption();
            const auto sweep = capture_->nextSweep();
            is_read_to_end_ = !sweep;
            if (!sweep) return endAfter(turns_ + 1);
            RecordedEntry entry;
            entry.number = turns_++;
            if (skips(entry.number)) continue;
            const auto turn = observationOf(*sweep);
            entry.object = objectOf(turn, options_.folder_objects);
            entry.fraction_read = capture_->fractionRead();
            addIfScan(turn, "", entry);
            return entry;
        }
        return endAfter(turns_);
    }
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override {
        return scanTimesOf(survey());
    }
    std::size_t scansKnown() const override { return turns_; }
    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks = capture_->remarks();
        if (!is_read_to_end_ && turns_ > options_.last_scan) {
            for (std::string& remark : remarks) remark += " (up to the last entry converted)";
        }
        return remarks;
    }

 protected:
    LogPoses readPoses(const std::filesystem::path& file) override {
        if (file.empty() || kindOfPoseFile(file) == PoseFileKind::Tum) {
            return posesOfRawlog(RawlogSurvey(), file);
        }
        const auto isKept = [this](const std::string& label) { return isSelected(label); };
        return posesOfRawlog(withScansOf(survey(), isKept), file);
    }
    /// Does nothing, because packets identify their sensor.
    bool showClouds(CloudSensors&) override { return false; }

 private:
    /// Reads the capture in advance, as far as it is readable.
    RawlogSurvey survey() {
        RawlogSurvey survey;
        std::size_t turns = 0;
        const auto ahead = sensors::openCapture(file_, options_.sensor_json, options_.calibration,
                                                [this] { checkInterruption(); });
        try {
            while (const auto sweep = ahead->nextSweep()) {
                checkInterruption();
                ++turns;
                const auto turn = observationOf(*sweep);
                survey.scans[sweep->label].push_back(
                    {turn->timestamp, mrpt::poses::CPose3D(turn->sensorPose())});
            }
        } catch (const sensors::BrokenCapture& e) {
            survey.is_whole = false;
            brokeOffAhead(turns, e.what());
        }
        return survey;
    }

    std::filesystem::path file_;
    std::unique_ptr<sensors::LidarCapture> capture_;
    std::size_t turns_ = 0;
    bool is_read_to_end_ = false;
};

}  // namespace

std::unique_ptr<ScanSource> openCaptureScans(const std::filesystem::path& capture,
                                             const SourceOptions& options) {
    return std::make_unique<CaptureSource>(capture, options);
}

}  // namespace hagen::recordings
