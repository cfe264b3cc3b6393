#pragma once
#include <hagen/logs/RawlogSurvey.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/observations/Trajectory.h>
#include <filesystem>

#include <string>
#include <vector>

namespace hagen::logs {

/// Where the vehicle of a log was, and how a user should read where that is known from.
struct LogPoses {
    observations::Trajectory vehicle;
    std::string source;  ///< such as "flight.tum"; empty: not known
};

/// The poses of a rawlog: those of `file` where it is given, else the log's own. A KITTI file needs
/// a line for each scan of the log's one LiDAR. Throws std::runtime_error, naming the file.
LogPoses posesOfRawlog(const RawlogSurvey& survey, const std::filesystem::path& file);

/// The poses of a scan folder, whose scans were taken at `times_s`: those of `file` where it is
/// given, else of its poses.tum, else of its poses.txt. What moves in a scan folder is the sensor.
LogPoses posesOfScanFolder(const ScanFolder& folder, const std::vector<double>& times_s,
                           const std::filesystem::path& file);

}  // namespace hagen::logs
