#include "avoidance/flights/TurnTransforms.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {

Attitude tiltOf(const Eigen::Quaterniond& attitude) {
    const Eigen::Vector3d up = attitude.conjugate() * Eigen::Vector3d::UnitZ();
    return {static_cast<float>(std::atan2(up.y(), up.z())),
            static_cast<float>(std::asin(std::clamp(-up.x(), -1.0, 1.0)))};
}

TurnTransforms::TurnTransforms(double start_s, const FlightTrace& trace, PoseBelief& belief) {
    for (int step = 0; step <= kSteps + 1; ++step) {
        const simulation::SensorPose pose = belief.at(trace, start_s + step * kStep_s);
        Eigen::Matrix<float, 3, 4> matrix;
        matrix << pose.attitude.toRotationMatrix().cast<float>(), pose.position_m.cast<float>();
        poses_[static_cast<std::size_t>(step)] = matrix;
    }
}

Eigen::Vector3f TurnTransforms::place(const Eigen::Vector3f& point_m, float since_start_s) const {
    const float at =
        std::clamp(since_start_s / static_cast<float>(kStep_s), 0.0f, static_cast<float>(kSteps));
    const auto before = static_cast<std::size_t>(at);
    const float share = at - static_cast<float>(before);
    const Eigen::Matrix<float, 3, 4> matrix =
        poses_[before] + share * (poses_[before + 1] - poses_[before]);
    return matrix * point_m.homogeneous();
}

}  // namespace hagen::avoidance
