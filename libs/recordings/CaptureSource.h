#pragma once
#include <hagen/recordings/RawlogSurvey.h>
#include <hagen/recordings/ScanSource.h>
#include "recordings/captures/LidarCapture.h"

namespace hagen::recordings {

/// A capture of LiDAR packets as a source of scans. Each turn of a sensor is an entry.
class CaptureSource : public ScanSource {
 public:
    CaptureSource(const std::filesystem::path& capture, const SourceOptions& options);

    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t scansKnown() const override { return turns_; }
    std::vector<std::string> remarks() const override;

 protected:
    LogPoses readPoses(const std::filesystem::path& file) override;
    /// Does nothing, because packets identify their sensor.
    bool showClouds(observations::CloudSensors&) override { return false; }

 private:
    /// Reads the capture in advance, as far as it is readable.
    RawlogSurvey survey();

    std::filesystem::path file_;
    std::unique_ptr<recordings::LidarCapture> capture_;
    std::size_t turns_ = 0;
    bool is_read_to_end_ = false;
};

}  // namespace hagen::recordings
