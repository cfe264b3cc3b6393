#pragma once
#include <hagen/mrpt/Trajectory.h>
#include <hagen/recordings/RawlogSurvey.h>
#include <hagen/recordings/ScanFolder.h>
#include <filesystem>

#include <set>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The vehicle's trajectory in a log, and its source.
struct LogPoses {
    observations::Trajectory vehicle;
    std::string source;  ///< for messages, such as "flight.tum"; empty if there are no poses
    /// True if the poses of all scans are sensor poses, which include the mount. Otherwise, this
    /// applies only to the LiDARs with the labels `of_sensors`.
    bool are_of_sensor = false;
    std::set<std::string> of_sensors = {};
    /// Labels of the LiDARs whose recorded attitude includes the mount.
    std::set<std::string> vehicles = {};
};

/// The poses of a rawlog: from `file` if it is given, otherwise from the log. A KITTI file must
/// have one line per scan, and the log only one LiDAR. Throws std::runtime_error naming the file.
LogPoses posesOfRawlog(const RawlogSurvey& survey, const std::filesystem::path& file);

/// The sensor poses of a scan folder with scans at `times_s`: from `file` if it is given, otherwise
/// from the folder's poses.tum or poses.txt.
LogPoses posesOfScanFolder(const ScanFolder& folder, const std::vector<double>& times_s,
                           const std::filesystem::path& file);

}  // namespace hagen::recordings
