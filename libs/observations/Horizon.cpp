#include <hagen/observations/Horizon.h>
#include <hagen/observations/TimeStamp.h>
#include <hagen/observations/Trajectory.h>
#include <mrpt/math/CQuaternion.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/system/datetime.h>

#include <cmath>
#include <initializer_list>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationIMU;
using mrpt::poses::CPose3D;

constexpr double kLongest_s = 0.2;

/// The rotation of the IMU against the horizon.
std::optional<CPose3D> rotationOf(const CObservationIMU& imu) {
    using namespace mrpt::obs;
    const auto hasAll = [&](std::initializer_list<TIMUDataIndex> what) {
        for (const TIMUDataIndex index : what) {
            if (!imu.has(index) || !std::isfinite(imu.get(index))) return false;
        }
        return true;
    };
    if (hasAll({IMU_ORI_QUAT_W, IMU_ORI_QUAT_X, IMU_ORI_QUAT_Y, IMU_ORI_QUAT_Z})) {
        const double w = imu.get(IMU_ORI_QUAT_W), x = imu.get(IMU_ORI_QUAT_X);
        const double y = imu.get(IMU_ORI_QUAT_Y), z = imu.get(IMU_ORI_QUAT_Z);
        const double norm = std::sqrt(w * w + x * x + y * y + z * z);
        if (norm > 0.5) {  // an IMU without orientation reports zeros
            return CPose3D(mrpt::math::CQuaternionDouble(w / norm, x / norm, y / norm, z / norm), 0,
                           0, 0);
        }
    }
    if (!hasAll({IMU_ROLL, IMU_PITCH})) return std::nullopt;
    return CPose3D(0, 0, 0, 0, imu.get(IMU_PITCH), imu.get(IMU_ROLL));
}

}  // namespace

void Horizon::see(const mrpt::obs::CObservation& observation) {
    if (!isTime(observation.timestamp)) return;
    std::optional<CPose3D> sensor;
    if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
        sensor = pose->pose.mean;
    } else if (const auto* imu = dynamic_cast<const CObservationIMU*>(&observation)) {
        sensor = rotationOf(*imu);
    }
    if (!sensor) return;
    const CPose3D vehicle = *sensor + (-CPose3D(observation.sensorPose()));
    if (!isFinite(vehicle)) return;
    vehicle_ = vehicle;
    time_ = observation.timestamp;
}

std::optional<CPose3D> Horizon::at(mrpt::Clock::time_point time) const {
    if (!vehicle_ || !isTime(time) ||
        std::abs(mrpt::system::timeDifference(time_, time)) > kLongest_s) {
        return std::nullopt;
    }
    return vehicle_;
}

}  // namespace hagen::observations
