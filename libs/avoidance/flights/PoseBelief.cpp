#include "avoidance/flights/PoseBelief.h"
#include <hagen/scan/Angle.h>
#include <algorithm>

#include "avoidance/flights/Streams.h"

namespace hagen::avoidance {
namespace {

constexpr double kKnot_s = 0.1;
constexpr double kNoise_m = 0.05, kNoise_rad = radians(0.5);
constexpr double kDrift = 0.01;

Eigen::Vector3d normals(double deviation, simulation::Random& random) {
    Eigen::Vector3d drawn;
    for (int axis = 0; axis < 3; ++axis) drawn[axis] = deviation * random.normal();
    return drawn;
}

Eigen::Quaterniond rotationOf(const Eigen::Vector3d& rotation_rad) {
    const double angle = rotation_rad.norm();
    if (angle == 0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_rad / angle));
}

}  // namespace

PoseBelief::PoseBelief(PoseError error, std::uint64_t seed)
    : error_(error), random_(seed, streams::kPose) {
    if (error_ == PoseError::Drift) direction_ = normals(1, random_).normalized();
}

PoseBelief::Knot PoseBelief::knotAt(double time_s) {
    const double at = std::max(0.0, time_s / kKnot_s);
    const auto before = static_cast<std::size_t>(at);
    while (knots_.size() < before + 2) {
        const Eigen::Vector3d offset_m = normals(kNoise_m, random_);
        const Eigen::Vector3d rotation_rad = normals(kNoise_rad, random_);
        knots_.push_back({offset_m, rotation_rad});
    }
    const Knot &a = knots_[before], &b = knots_[before + 1];
    const double share = at - static_cast<double>(before);
    return {a.offset_m + share * (b.offset_m - a.offset_m),
            a.rotation_rad + share * (b.rotation_rad - a.rotation_rad)};
}

Eigen::Vector3d PoseBelief::offset_m(const FlightTrace& trace, double time_s) {
    if (error_ == PoseError::Noise) return knotAt(time_s).offset_m;
    if (error_ == PoseError::Drift) return kDrift * trace.distance_m(time_s) * direction_;
    return Eigen::Vector3d::Zero();
}

simulation::SensorPose PoseBelief::at(const FlightTrace& trace, double time_s) {
    simulation::SensorPose pose = trace.at(time_s);
    pose.position_m += offset_m(trace, time_s);
    if (error_ == PoseError::Noise) {
        pose.attitude = rotationOf(knotAt(time_s).rotation_rad) * pose.attitude;
    }
    return pose;
}

}  // namespace hagen::avoidance
