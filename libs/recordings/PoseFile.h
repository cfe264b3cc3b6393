#pragma once
#include <mrpt/poses/CPose3D.h>
#include <filesystem>

#include <vector>

namespace hagen::recordings {

/// Formats of text files with one pose per line. The functions below skip empty lines and lines
/// that start with '#', and throw std::runtime_error naming file and line.
enum class PoseFileKind {
    Tum,   ///< time [s], x y z [m], quaternion x y z w: vehicle pose in the map
    Kitti  ///< 3x4 matrix, row-major: sensor pose at scan n, relative to scan 0
};

/// Detects the format by the number of columns in the first line: 8 or 12.
PoseFileKind kindOfPoseFile(const std::filesystem::path& file);

struct TimedPose {
    double time_s;
    mrpt::poses::CPose3D pose;
};
std::vector<TimedPose> readTumPoses(const std::filesystem::path& file);
void writeTumPoses(const std::filesystem::path& file, const std::vector<TimedPose>& poses);

std::vector<mrpt::poses::CPose3D> readKittiPoses(const std::filesystem::path& file);
/// Writes sensor poses relative to the first pose. They may be given in any map frame.
void writeKittiPoses(const std::filesystem::path& file,
                     const std::vector<mrpt::poses::CPose3D>& sensor_poses);

/// Reads the `Tr:` matrix of a KITTI odometry calib.txt: the LiDAR pose in the camera frame. If
/// this file exists, poses.txt contains camera poses.
mrpt::poses::CPose3D readKittiCalibration(const std::filesystem::path& file);

}  // namespace hagen::recordings
