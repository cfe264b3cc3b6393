#pragma once
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/RawlogSurvey.h>
#include <hagen/recordings/ScanSource.h>

namespace hagen::recordings {

/// A rawlog as a source of scans. Entries are objects of the file; a sensory frame may hold several
/// scans.
class RawlogSource : public ScanSource {
 public:
    RawlogSource(const std::filesystem::path& rawlog, const SourceOptions& options);

    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t entriesKnown() const override { return reader_.entries(); }
    /// Without a LiDAR scan: what the entries have instead.
    std::vector<std::string> remarks() const override;

 protected:
    LogPoses readPoses(const std::filesystem::path& file) override;
    bool showClouds(observations::CloudSensors& sensors) override;

 private:
    const RawlogSurvey& survey();

    std::filesystem::path rawlog_;
    RawlogReader reader_;
    std::size_t null_objects_ = 0;            ///< taken out of sensory frames
    bool has_scans_ = false;                  ///< among the selected entries
    std::map<std::string, std::size_t> has_;  ///< number of objects of each class among them
    std::unique_ptr<RawlogReader> ahead_;     ///< of showClouds(); made on demand
    std::size_t poses_not_finite_ = 0;
    std::optional<RawlogSurvey> survey_;  ///< made on demand
};

}  // namespace hagen::recordings
