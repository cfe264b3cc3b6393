#pragma once
#include <hagen/recordings/RawlogSurvey.h>
#include <hagen/recordings/ScanSource.h>

#include <map>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The sensor label of all clouds in files.
constexpr const char* kCloudLabel = "lidar";

/// A point cloud file (clouds/CloudFile.h), or a folder of them in the order of their names, as a
/// source of scans: each file is an entry. Times are those of the names, if they are times
/// (CloudTimes.h).
class CloudFileSource : public ScanSource {
 public:
    /// Throws std::runtime_error if a folder has no such files.
    CloudFileSource(const std::filesystem::path& file_or_folder, const SourceOptions& options);

    /// Whether a folder has files with the names of cloud files.
    static bool hasClouds(const std::filesystem::path& folder);

    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t entriesKnown() const override { return files_.size(); }
    std::vector<std::string> remarks() const override;

 protected:
    /// Cloud files have no poses of their own.
    LogPoses readPoses(const std::filesystem::path& file) override;
    bool showClouds(observations::CloudSensors& sensors) override;

 private:
    mrpt::obs::CObservationPointCloud::Ptr read(std::size_t i);

    std::vector<std::filesystem::path> files_;
    std::vector<std::string> names_;  ///< without extension, unless they would be the same
    std::vector<double> times_s_;
    std::string time_remark_;
    std::size_t other_files_ = 0, folders_ = 0;  ///< beside them
    std::size_t next_ = 0, next_shown_ = 0;
    std::size_t clouds_ = 0, points_not_finite_ = 0, clouds_with_them_ = 0;
    std::vector<std::string> remarks_;                ///< in the order of appearance
    std::map<std::string, std::size_t> with_remark_;  ///< clouds
};

}  // namespace hagen::recordings
