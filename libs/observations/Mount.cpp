#include <hagen/observations/Mount.h>
#include <algorithm>
#include <cmath>

namespace hagen::observations {
namespace {

bool isLevel(const Attitude& attitude) { return attitude.roll_rad == 0 && attitude.pitch_rad == 0; }

Attitude attitudeOf(const Eigen::Matrix3f& level_from_sensor) {
    return {std::atan2(level_from_sensor(2, 1), level_from_sensor(2, 2)),
            std::asin(std::clamp(-level_from_sensor(2, 0), -1.0f, 1.0f))};
}

}  // namespace

std::optional<Attitude> sensorTilt(const ScanPose& pose,
                                   const mrpt::poses::CPose3D& sensor_on_vehicle,
                                   const Attitude& mount) {
    const Attitude recorded{static_cast<float>(sensor_on_vehicle.roll()),
                            static_cast<float>(sensor_on_vehicle.pitch())};
    if (!isLevel(recorded)) return pose.attitude.value_or(recorded);
    if (isLevel(mount) || (pose.attitude && pose.is_of_sensor)) return pose.attitude;
    if (!pose.attitude) return mount;
    return attitudeOf(levelFromSensor(*pose.attitude) * levelFromSensor(mount));
}

}  // namespace hagen::observations
