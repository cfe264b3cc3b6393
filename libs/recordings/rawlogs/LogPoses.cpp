#include <hagen/mrpt/TimeStamp.h>
#include <hagen/recordings/LogPoses.h>
#include "recordings/PoseFile.h"
#include "recordings/Remarks.h"

#include <map>
#include <stdexcept>

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using mrpt::poses::CPose3D;
using ScanPlaces = std::vector<RawlogSurvey::ScanPlace>;

observations::Trajectory trajectoryOfTum(const fs::path& file) {
    observations::Trajectory trajectory;
    for (const TimedPose& pose : readTumPoses(file)) {
        trajectory.add(mrpt::Clock::fromDouble(pose.time_s), pose.pose);
    }
    return trajectory;
}

observations::Trajectory trajectoryOfKitti(const fs::path& file,
                                           const std::vector<CPose3D>& sensor_poses,
                                           const ScanPlaces& scans, bool are_all_scans = true) {
    const bool fits =
        are_all_scans ? sensor_poses.size() == scans.size() : sensor_poses.size() >= scans.size();
    if (!fits) {
        throw std::runtime_error(file.string() + ": has " + counted(sensor_poses.size(), "pose") +
                                 " for " + counted(scans.size(), "scan"));
    }
    observations::Trajectory trajectory;
    trajectory.has_horizon = false;  // poses are relative to the first scan, which may be tilted
    std::map<mrpt::Clock::time_point, std::size_t> scan_at;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (!observations::isTime(scans[i].time)) continue;  // scan without time
        const auto [earlier, is_new] = scan_at.try_emplace(scans[i].time, i);
        if (!is_new && sensor_poses[i] != sensor_poses[earlier->second]) {
            throw std::runtime_error(file.string() + ": scans " + std::to_string(earlier->second) +
                                     " and " + std::to_string(i) +
                                     " have different poses, but the same time; scan times must "
                                     "differ");
        }
        trajectory.add(scans[i].time, sensor_poses[i] + (-scans[i].sensor_on_vehicle));
    }
    return trajectory;
}

/// Reads a pose file of either format.
observations::Trajectory trajectoryOf(const fs::path& file, const ScanPlaces& scans,
                                      bool are_all_scans) {
    return kindOfPoseFile(file) == PoseFileKind::Tum
               ? trajectoryOfTum(file)
               : trajectoryOfKitti(file, readKittiPoses(file), scans, are_all_scans);
}

/// Reads poses.txt of a scan folder. If there is a calib.txt, poses are camera poses, as in KITTI.
std::vector<CPose3D> ownKittiPoses(const ScanFolder& folder) {
    std::vector<CPose3D> poses = readKittiPoses(folder.kittiPosesFile());
    if (!fs::exists(folder.calibrationFile())) return poses;
    const CPose3D lidar_in_camera = readKittiCalibration(folder.calibrationFile());
    for (CPose3D& pose : poses) pose = (-lidar_in_camera) + pose + lidar_in_camera;
    return poses;
}

}  // namespace

LogPoses posesOfRawlog(const RawlogSurvey& survey, const fs::path& file) {
    if (file.empty()) return {survey.trajectory, survey.source};
    if (kindOfPoseFile(file) == PoseFileKind::Kitti && survey.scans.size() != 1) {
        throw std::runtime_error(
            file.string() +
            ": a KITTI file has one pose per scan of a single LiDAR, but the log has " +
            std::to_string(survey.scans.size()) + " LiDARs; use poses with times (TUM)");
    }
    const ScanPlaces none;
    return {trajectoryOf(file, survey.scans.empty() ? none : survey.scans.begin()->second,
                         survey.is_whole),
            file.string(), kindOfPoseFile(file) == PoseFileKind::Kitti};
}

LogPoses posesOfScanFolder(const ScanFolder& folder, const std::vector<double>& times_s,
                           const fs::path& file) {
    ScanPlaces scans;
    for (const double time_s : times_s) scans.push_back({mrpt::Clock::fromDouble(time_s), {}});
    if (!file.empty()) return {trajectoryOf(file, scans, true), file.string(), true};
    if (fs::exists(folder.tumFile())) {
        return {trajectoryOfTum(folder.tumFile()), folder.tumFile().string(), true};
    }
    if (!fs::exists(folder.kittiPosesFile())) return {};
    return {trajectoryOfKitti(folder.kittiPosesFile(), ownKittiPoses(folder), scans),
            folder.kittiPosesFile().string(), true};
}

}  // namespace hagen::recordings
