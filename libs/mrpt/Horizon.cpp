#include <hagen/mrpt/Horizon.h>
#include <hagen/mrpt/TimeStamp.h>
#include <hagen/mrpt/Trajectory.h>
#include <mrpt/math/CQuaternion.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/system/datetime.h>

#include <cmath>
#include <cstring>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationIMU;
using mrpt::poses::CPose3D;

constexpr double kMaxAge_s = 0.2;

/// The measurement, if present and finite. Flags of corrupt recordings may be neither true nor
/// false; they must not be read as bool, and are treated as missing.
std::optional<double> measured(const CObservationIMU& imu, mrpt::obs::TIMUDataIndex what) {
    unsigned char is_present = 0;
    static_assert(sizeof(imu.dataIsPresent.at(what)) == sizeof(is_present));
    std::memcpy(&is_present, &imu.dataIsPresent.at(what), sizeof(is_present));
    const double value = imu.rawMeasurements.at(what);
    if (is_present != 1 || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// The rotation of the IMU relative to the horizon.
std::optional<CPose3D> rotationOf(const CObservationIMU& imu) {
    using namespace mrpt::obs;
    const auto w = measured(imu, IMU_ORI_QUAT_W), x = measured(imu, IMU_ORI_QUAT_X);
    const auto y = measured(imu, IMU_ORI_QUAT_Y), z = measured(imu, IMU_ORI_QUAT_Z);
    if (w && x && y && z) {
        const double norm = std::sqrt(*w * *w + *x * *x + *y * *y + *z * *z);
        if (norm > 0.5 && std::isfinite(norm)) {  // an IMU without orientation reports zeros
            return CPose3D(
                mrpt::math::CQuaternionDouble(*w / norm, *x / norm, *y / norm, *z / norm), 0, 0, 0);
        }
    }
    const auto pitch = measured(imu, IMU_PITCH), roll = measured(imu, IMU_ROLL);
    if (!pitch || !roll) return std::nullopt;
    return CPose3D(0, 0, 0, 0, *pitch, *roll);
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
        std::abs(mrpt::system::timeDifference(time_, time)) > kMaxAge_s) {
        return std::nullopt;
    }
    return vehicle_;
}

}  // namespace hagen::observations
