#include <hagen/mrpt/TimeStamp.h>
#include <hagen/mrpt/Trajectory.h>
#include <Eigen/Core>

#include <chrono>
#include <cmath>

namespace hagen::observations {

bool isFinite(const mrpt::poses::CPose3D& pose) {
    return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.z()) &&
           pose.getRotationMatrix().asEigen().allFinite();
}

Trajectory::Trajectory() {
    poses_.setInterpolationMethod(mrpt::poses::imLinear2Neig);
    poses_.setMaxTimeInterpolation(std::chrono::milliseconds(200));
}

void Trajectory::add(mrpt::Clock::time_point time, const mrpt::poses::CPose3D& vehicle_pose) {
    if (!isFinite(vehicle_pose)) {
        ++not_finite;
    } else if (isTime(time)) {
        poses_.insert(time, vehicle_pose);
    }
}

std::optional<mrpt::poses::CPose3D> Trajectory::at(mrpt::Clock::time_point time) const {
    if (!isTime(time)) return std::nullopt;
    mrpt::poses::CPose3D pose;
    bool is_valid = false;
    poses_.interpolate(time, pose, is_valid);
    return is_valid ? std::optional(pose) : std::nullopt;
}

}  // namespace hagen::observations
