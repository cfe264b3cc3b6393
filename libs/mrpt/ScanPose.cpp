#include <hagen/mrpt/ScanPose.h>

namespace hagen::observations {

using mrpt::poses::CPose3D;

ScanPose scanPoseOf(const mrpt::obs::CObservation& scan, const Trajectory& vehicle,
                    const Horizon& horizon, bool is_of_sensor) {
    const CPose3D sensor_on_vehicle(scan.sensorPose());
    if (!isFinite(sensor_on_vehicle)) return {};
    ScanPose pose;
    pose.sensor_pose = vehicle.at(scan.timestamp);
    if (pose.sensor_pose) *pose.sensor_pose += sensor_on_vehicle;
    pose.is_of_sensor = is_of_sensor;
    pose.pose_has_horizon = pose.sensor_pose && vehicle.has_horizon;

    std::optional<CPose3D> levelled = horizon.at(scan.timestamp);
    if (levelled) {
        *levelled += sensor_on_vehicle;
    } else if (pose.pose_has_horizon) {
        levelled = pose.sensor_pose;
        pose.attitude_is_of_sensor = is_of_sensor;
    }
    if (levelled) {
        pose.attitude =
            Attitude{static_cast<float>(levelled->roll()), static_cast<float>(levelled->pitch())};
    }
    return pose;
}

}  // namespace hagen::observations
