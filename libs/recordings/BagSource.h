#pragma once
#include <hagen/recordings/BagScans.h>
#include <hagen/recordings/RawlogSurvey.h>
#include <hagen/recordings/ScanSource.h>

namespace hagen::recordings {

/// A ROS recording as a source of scans: each is an entry. It is read in advance once, for what
/// may come after the first scan: poses, frames, metadata.
class BagSource : public ScanSource {
 public:
    BagSource(const std::filesystem::path& bag, const SourceOptions& options);

    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t entriesKnown() const override { return scans_read_; }
    std::vector<std::string> remarks() const override;

 protected:
    LogPoses readPoses(const std::filesystem::path& file) override;
    bool showClouds(observations::CloudSensors& sensors) override;

 private:
    /// Reads the times of all scans, up to where the bag breaks off.
    RawlogSurvey surveyScans();
    recordings::BagSurvey surveyInAdvance();
    std::unique_ptr<recordings::BagScans> openScans() const;

    std::filesystem::path file_;
    recordings::BagSurvey survey_;
    std::unique_ptr<recordings::BagScans> scans_;
    std::unique_ptr<recordings::BagScans> ahead_;  ///< of showClouds(); while it is ahead
    std::size_t shown_ = 0, seen_ = 0;             ///< observations read by ahead_, and by scans_
    std::size_t scans_read_ = 0;
    bool is_read_to_end_ = false;
};

}  // namespace hagen::recordings
