#pragma once
#include <hagen/logs/PoseFile.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/segmentation/Extraction.h>
#include <mrpt/poses/CPose3D.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::logs {

/// The name of scan n in a scan folder: "000042".
std::string scanName(std::size_t scan);

/// Writes segmented scans as a scan folder; see ScanFolder.h. Functions throw std::runtime_error,
/// naming the file that cannot be written.
class ScanFolderWriter {
 public:
    /// Makes velodyne/ and labels/ in a folder that exists.
    explicit ScanFolderWriter(std::filesystem::path folder);

    /// Adds a scan. Labels are those of the first scan.size() returns. `sensor_pose`: the sensor in
    /// the map at the scan's time, where it is known; `pose_has_horizon`: that map's z axis points
    /// against gravity.
    void write(const std::string& name, const Scan& scan, const LabelledReturns& returns,
               const SensorModel& sensor, double time_s,
               const std::optional<mrpt::poses::CPose3D>& sensor_pose = std::nullopt,
               bool pose_has_horizon = true);

    /// Ends it: times.txt (seconds since the first scan), poses.tum of the scans whose pose is
    /// known, if all those have a horizon, for its readers level by them; and poses.txt where the
    /// poses of all are known.
    void finish() const;

 private:
    std::filesystem::path folder_;
    double first_time_s_ = 0;
    std::vector<double> times_s_;  ///< since the first scan
    std::vector<TimedPose> poses_;
    bool have_horizon_ = true;
};

}  // namespace hagen::logs
