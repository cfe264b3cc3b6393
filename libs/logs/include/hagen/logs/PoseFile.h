#pragma once
#include <mrpt/poses/CPose3D.h>
#include <filesystem>

#include <vector>

namespace hagen::logs {

/// Files of poses, as text, a line a pose; functions throw std::runtime_error, naming file and
/// line. Empty lines, and those that start with '#', are passed over.
enum class PoseFileKind {
    Tum,   ///< time [s], x y z [m], quaternion x y z w: the vehicle in the map at that time
    Kitti  ///< 3x4 matrix, row by row: the sensor at scan n, seen from where scan 0 was taken
};

/// The kind, by how many numbers the first line has: 8 or 12.
PoseFileKind kindOfPoseFile(const std::filesystem::path& file);

struct TimedPose {
    double time_s;
    mrpt::poses::CPose3D pose;
};
std::vector<TimedPose> readTumPoses(const std::filesystem::path& file);
void writeTumPoses(const std::filesystem::path& file, const std::vector<TimedPose>& poses);

std::vector<mrpt::poses::CPose3D> readKittiPoses(const std::filesystem::path& file);
/// Writes sensor poses of any map, seen from the first.
void writeKittiPoses(const std::filesystem::path& file,
                     const std::vector<mrpt::poses::CPose3D>& sensor_poses);

/// Reads the matrix behind `Tr:` of a calib.txt as KITTI's odometry benchmark has it: the LiDAR
/// seen from the camera. Its poses.txt are the camera's.
mrpt::poses::CPose3D readKittiCalibration(const std::filesystem::path& file);

}  // namespace hagen::logs
