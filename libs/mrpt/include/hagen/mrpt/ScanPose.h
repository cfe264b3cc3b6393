#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/mrpt/Horizon.h>
#include <hagen/mrpt/Trajectory.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

namespace hagen::observations {

/// Pose and attitude of the sensor at the time of a scan.
struct ScanPose {
    /// Sensor pose in the map at the scan's time; nullopt if the trajectory does not cover it.
    std::optional<mrpt::poses::CPose3D> sensor_pose;
    bool pose_has_horizon = false;     ///< whether the map is gravity-aligned
    std::optional<Attitude> attitude;  ///< tilt of the sensor, if known
    /// The pose or attitude belongs to the sensor itself and includes the mount, if any.
    bool is_of_sensor = false, attitude_is_of_sensor = false;
    mrpt::poses::CPose3D sensor_on_vehicle;  ///< includes the mount of mountedPose()
};

/// The pose of a scan: interpolated from the vehicle's trajectory and composed with the recorded
/// sensor pose. The attitude comes from `horizon` if recent, otherwise from a trajectory with a
/// horizon. `is_of_sensor` means that the trajectory belongs to the sensor itself.
ScanPose scanPoseOf(const mrpt::obs::CObservation& scan, const Trajectory& vehicle,
                    const Horizon& horizon, bool is_of_sensor = false);

}  // namespace hagen::observations
