#pragma once
#include <hagen/recordings/ScanSource.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>
#include <vector>

namespace hagen::recordings {

/// Cloud files as a source of scans. Each file is an entry.
class FileListSource : public ScanSource {
 public:
    std::optional<RecordedEntry> nextEntry() override;
    std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimes() override;
    std::size_t scansKnown() const override { return names_.size(); }

 protected:
    using Cloud = mrpt::obs::CObservationPointCloud::Ptr;

    FileListSource(const SourceOptions& options, const char* sensor_label)
        : ScanSource(options), label_(sensor_label) {}

    /// Reads the cloud of a file; may be called in advance. Throws BrokenRecording naming the file.
    virtual Cloud read(std::size_t file) = 0;
    /// Called for each entry with its cloud. Returns the entry's object.
    virtual mrpt::serialization::CSerializable::Ptr take(const Cloud& cloud) = 0;
    bool showClouds(CloudSensors& sensors) override;

    mrpt::Clock::time_point timeOf(std::size_t file) const {
        return mrpt::Clock::fromDouble(times_s_[file]);
    }

    const char* const label_;
    std::vector<std::string> names_;
    std::vector<double> times_s_;

 private:
    std::size_t next_ = 0, next_shown_ = 0;
};

}  // namespace hagen::recordings
