#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/filter/Levelling.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <mrpt/poses/CPose3D.h>
#include "recordings/PoseFile.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::convert {

/// File name of scan n in a scan folder, without extension: "000042".
std::string scanName(std::size_t scan);

/// Range limits from the settings; nullopt for the sensor's limits.
struct GivenLimits {
    std::optional<float> min_range_m, max_range_m;
};

/// Writes segmented scans as a scan folder; see ScanFolder.h. Functions throw std::runtime_error
/// naming the file that cannot be written.
class ScanFolderWriter {
 public:
    /// Creates velodyne/ and labels/ in an existing folder. `mount` is the sensor's tilt on the
    /// level vehicle, for sensor.yaml. With `unnamed`, the sensor is unnamed, and sensor.yaml
    /// contains only these limits, not the recovered beams.
    explicit ScanFolderWriter(std::filesystem::path folder, const Attitude& mount = {},
                              const std::optional<GivenLimits>& unnamed = std::nullopt);

    /// Adds a scan with the labels of its returns. `sensor_pose` is the sensor pose in the map at
    /// the scan's time, if known. `pose_has_horizon` means that the z axis of the map points
    /// against gravity.
    void write(const std::string& name, const Scan& scan, const LabelledReturns& returns,
               const SensorModel& sensor, double time_s,
               const std::optional<mrpt::poses::CPose3D>& sensor_pose = std::nullopt,
               bool pose_has_horizon = true);

    /// Scans written so far.
    std::size_t scans() const { return times_s_.size(); }

    /// Writes times.txt (seconds on the recording's clock). Writes poses.tum with the known poses
    /// if all of them are gravity-aligned, because readers use them for levelling, and poses.txt if
    /// all poses are known.
    void finish() const;

 private:
    std::filesystem::path folder_;
    Attitude mount_;
    std::optional<GivenLimits> unnamed_;
    std::vector<std::string> names_;  ///< scan names; the other lists have one entry per scan, too
    std::vector<double> times_s_;
    std::vector<std::optional<mrpt::poses::CPose3D>> poses_;
    bool have_horizon_ = true;
};

}  // namespace hagen::convert
