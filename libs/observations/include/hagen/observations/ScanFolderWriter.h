#pragma once
#include <hagen/observations/OutputPath.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/segmentation/Extraction.h>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen {

/// Writes segmented scans as a scan folder (see ScanFolder.h) that appears under its name when
/// whole: velodyne/, labels/, times.txt (seconds since the first scan) and sensor.yaml.
class ScanFolderWriter {
 public:
    /// Throws std::runtime_error, naming the folder; see OutputPath.
    ScanFolderWriter(const std::filesystem::path& folder, bool overwrite);

    /// Adds a scan under this name, or under the next number (000000, ...). Labels are those of the
    /// first scan.size() returns. Throws std::runtime_error where a file cannot be written.
    void write(const Scan& scan, const LabelledReturns& returns, const SensorModel& sensor,
               double time_s, const std::string& name = "");

    /// Copies the recording's poses.txt along.
    void copyPoses(const std::filesystem::path& poses_file);

    void commit();
    std::filesystem::path keepPartial();

 private:
    void writeTimes() const;

    OutputPath path_;
    std::vector<double> times_s_;
};

}  // namespace hagen
