#pragma once
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>

namespace hagen::recordings {

/// A scan folder as a source of scans: each scan is an entry.
class ScanFolderSource : public ScanSource {
 public:
    ScanFolderSource(const std::filesystem::path& folder, const SourceOptions& options);

    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t entriesKnown() const override { return folder_.size(); }
    std::vector<std::string> remarks() const override;
    /// Merges the folder's sensor.yaml.
    Settings settingsFor(const Settings& settings) const override;

 protected:
    LogPoses readPoses(const std::filesystem::path& file) override;
    bool showClouds(observations::CloudSensors& sensors) override;

 private:
    ScanFolder folder_;
    std::vector<double> times_s_;
    std::size_t next_ = 0;
    std::size_t next_shown_ = 0;  ///< of showClouds()
    Scan scan_;
    bool has_rings_ = false;  ///< of the points that were read
};

}  // namespace hagen::recordings
