#include "recordings/PoseFile.h"
#include "recordings/Remarks.h"
#include "recordings/bags/BagScans.h"

#include "recordings/ScanObject.h"
#include "recordings/Sources.h"
#include "recordings/bags/PoseSeries.h"

namespace hagen::recordings {
namespace {

class BagSource : public ScanSource {
 public:
    BagSource(const std::filesystem::path& bag, const SourceOptions& options)
        : ScanSource(options), file_(bag), survey_(surveyInAdvance()), scans_(openScans(true)) {}

    std::optional<RecordedEntry> nextEntry() override {
        while (scans_read_ <= options_.last_scan) {
            checkInterruption();
            const auto observation = scans_->next();
            is_read_to_end_ = observation == nullptr;
            if (!observation) return endAfter(scans_->messagesRead() + 1);
            if (++seen_ > shown_) ahead_.reset();  // rarely needed again, but uses memory
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
        return endAfter(scans_->messagesRead());
    }

    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override {
        return scanTimesOf(surveyScans());
    }
    std::size_t scansKnown() const override { return scans_read_; }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks = scans_->remarks();
        if (!is_read_to_end_ && scans_read_ > options_.last_scan) {
            for (std::string& remark : remarks) remark += " (up to the last entry converted)";
        }
        return remarks;
    }

 private:
    BagSurvey surveyInAdvance() {
        bool is_interrupted = false;
        BagSurvey survey = surveyBag(file_, [&] {
            is_interrupted = !options_.keep_going();
            return !is_interrupted;
        });
        if (is_interrupted) throw Interrupted("interrupted");
        if (!survey.broken_because.empty()) brokeOffAhead(survey.messages, survey.broken_because);
        return survey;
    }

    std::unique_ptr<BagScans> openScans(bool passes_packets = false) const {
        BagOptions options{options_.topics, options_.sensor_json};
        options.first_scan = options_.first_scan;
        if (passes_packets && options_.packet) {
            options.packet = [this](const std::string& label, const sensors::Datagram& datagram) {
                const bool is_skipped = scans_read_ < options_.first_scan;
                if (!is_skipped && isSelected(label)) options_.packet(label, datagram);
            };
        }
        auto scans = std::make_unique<BagScans>(file_, survey_, options);
        scans->checkWhileReading([this] { checkInterruption(); });
        return scans;
    }

    /// Surveys all scans, as far as the bag is readable.
    RawlogSurvey surveyScans() {
        RawlogSurvey survey;
        const auto ahead = openScans();
        try {
            while (const auto scan = ahead->next()) {
                checkInterruption();
                if (!observations::isLidarScan(*scan)) continue;
                survey.scans[scan->sensorLabel].push_back(
                    {scan->timestamp, mrpt::poses::CPose3D(scan->sensorPose())});
            }
        } catch (const BrokenRecording& e) {
            survey.is_whole = false;
            brokeOffAhead(ahead->messagesRead(), e.what());
        }
        return survey;
    }

    LogPoses readPoses(const std::filesystem::path& file) override {
        if (file.empty()) return ownPoses();
        if (kindOfPoseFile(file) == PoseFileKind::Tum) return posesOfRawlog(RawlogSurvey(), file);
        const auto isKept = [this](const std::string& label) { return isSelected(label); };
        return posesOfRawlog(withScansOf(surveyScans(), isKept), file);
    }

    /// Poses of the bag. The z axis of ROS frames points up (REP 103).
    LogPoses ownPoses() const {
        LogPoses poses;
        const BagPlan& plan = scans_->plan();
        if (plan.poses != nullptr) {
            poses.source = plan.poses->source;
            for (const RecordedPose& pose : plan.poses->poses) {
                poses.vehicle.add(timeOf(pose.time_ns), poseOf(pose));
            }
        }
        for (const auto& [topic, sensor] : plan.sensors) {
            if (sensor.has_its_own_poses) poses.of_sensors.insert(sensor.label);
            if (sensor.is_vehicle || sensor.has_imu) poses.vehicles.insert(sensor.label);
        }
        return poses;
    }

    bool showClouds(CloudSensors& sensors) override {
        try {
            if (!ahead_) {
                ahead_ = openScans();
                for (std::size_t i = 0; i < shown_; ++i) ahead_->next();
            }
            ++shown_;
            const auto observation = ahead_->next();
            if (!observation) return false;
            observations::showCloud(*observation, sensors);
            return true;
        } catch (const BrokenRecording& e) {
            brokeOffAhead(ahead_ ? ahead_->messagesRead() : 0, e.what());
            return false;
        }
    }

    std::filesystem::path file_;
    BagSurvey survey_;
    std::unique_ptr<BagScans> scans_;
    std::unique_ptr<BagScans> ahead_;   ///< reads ahead for showClouds()
    std::size_t shown_ = 0, seen_ = 0;  ///< number of observations read by ahead_ and by scans_
    std::size_t scans_read_ = 0;
    bool is_read_to_end_ = false;
};

}  // namespace

std::unique_ptr<ScanSource> openBagScans(const std::filesystem::path& bag,
                                         const SourceOptions& options) {
    return std::make_unique<BagSource>(bag, options);
}

}  // namespace hagen::recordings
