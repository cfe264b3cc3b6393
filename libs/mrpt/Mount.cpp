#include "mrpt/Mount.h"
#include <algorithm>
#include <cmath>

namespace hagen::observations {
namespace {

constexpr float kRounding_rad = 1e-4f;  // rounding error of composed poses

bool isLevel(const Attitude& attitude) { return attitude.roll_rad == 0 && attitude.pitch_rad == 0; }
bool isMountUsed(const Attitude& recorded, const Attitude& mount) {
    return std::abs(recorded.roll_rad) < kRounding_rad &&
           std::abs(recorded.pitch_rad) < kRounding_rad && !isLevel(mount);
}

Attitude attitudeOf(const Eigen::Matrix3f& level_from_sensor) {
    return {std::atan2(level_from_sensor(2, 1), level_from_sensor(2, 2)),
            std::asin(std::clamp(-level_from_sensor(2, 0), -1.0f, 1.0f))};
}

}  // namespace

Attitude mountOf(const Attitude& recorded, const Attitude& mount) {
    return isMountUsed(recorded, mount) ? mount : recorded;
}

ScanPose mountedPose(const ScanPose& pose, const mrpt::poses::CPose3D& recorded,
                     const Attitude& mount) {
    ScanPose mounted = pose;
    mounted.sensor_on_vehicle = recorded;
    const Attitude tilt{static_cast<float>(recorded.roll()), static_cast<float>(recorded.pitch())};
    if (!isLevel(tilt) && !isMountUsed(tilt, mount)) {
        mounted.attitude = pose.attitude.value_or(tilt);
        return mounted;
    }
    if (isLevel(mount)) return mounted;
    if (!pose.attitude) {
        mounted.attitude = mount;
    } else if (!pose.attitude_is_of_sensor) {
        mounted.attitude = attitudeOf(levelFromSensor(*pose.attitude) * levelFromSensor(mount));
    }
    if (pose.is_of_sensor) return mounted;
    const mrpt::poses::CPose3D turn(0, 0, 0, 0, static_cast<double>(mount.pitch_rad),
                                    static_cast<double>(mount.roll_rad));
    mounted.sensor_on_vehicle += turn;
    if (mounted.sensor_pose) *mounted.sensor_pose += turn;
    return mounted;
}

}  // namespace hagen::observations
