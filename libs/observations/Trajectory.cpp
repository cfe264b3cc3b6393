#include <hagen/observations/RawlogReader.h>
#include <hagen/observations/Trajectory.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <chrono>

namespace hagen {
namespace {

void addPose(const mrpt::obs::CObservation& observation, Trajectory& trajectory) {
    const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation);
    if (pose == nullptr) return;
    // What tells the pose may sit aside of the vehicle's own frame.
    trajectory.add(pose->timestamp, pose->pose.mean + (-pose->sensorPose));
}

}  // namespace

Trajectory::Trajectory() {
    poses_.setInterpolationMethod(mrpt::poses::imLinear2Neig);
    poses_.setMaxTimeInterpolation(std::chrono::milliseconds(200));
}

void Trajectory::add(mrpt::Clock::time_point time, const mrpt::poses::CPose3D& vehicle_pose) {
    poses_.insert(time, vehicle_pose);
}

std::optional<mrpt::poses::CPose3D> Trajectory::at(mrpt::Clock::time_point time) const {
    mrpt::poses::CPose3D pose;
    bool is_valid = false;
    poses_.interpolate(time, pose, is_valid);
    return is_valid ? std::optional(pose) : std::nullopt;
}

Trajectory readTrajectory(const std::filesystem::path& rawlog) {
    Trajectory trajectory;
    RawlogReader reader(rawlog);
    try {
        while (const auto entry = reader.next()) {
            if (const auto one = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry)) {
                addPose(*one, trajectory);
            } else if (const auto frame =
                           std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
                for (const auto& observation : *frame) addPose(*observation, trajectory);
            }
        }
    } catch (const BrokenRawlog&) {
        // Whoever converts the log tells of the break; the poses before it are good.
    }
    return trajectory;
}

}  // namespace hagen
