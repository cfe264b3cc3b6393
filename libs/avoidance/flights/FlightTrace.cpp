#include "avoidance/flights/FlightTrace.h"
#include <algorithm>
#include <cmath>

namespace hagen::avoidance {
namespace {

constexpr double kGravity_m_s2 = 9.81;

Eigen::Quaterniond tiltedBy(const Eigen::Vector3d& acceleration_m_s2) {
    const Eigen::Vector3d thrust =
        acceleration_m_s2 + Eigen::Vector3d(0, 0, kGravity_m_s2);  // thrust per unit mass
    return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), thrust);
}

}  // namespace

FlightTrace::FlightTrace(const VehicleState& start) {
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    samples_.push_back({{start.position_m, tiltedBy(none)}, none, 0});
}

void FlightTrace::add(const VehicleState& state, const Eigen::Vector3d& acceleration_m_s2) {
    const Sample& last = samples_.back();
    const double share = 1 - std::exp(-kControlStep_s / kTilt_s);
    const Eigen::Vector3d change = share * (acceleration_m_s2 - last.smooth_m_s2);
    const Eigen::Vector3d smooth = last.smooth_m_s2 + change;
    const double distance_m = last.distance_m + (state.position_m - last.pose.position_m).norm();
    squared_jerk_ += (change / kControlStep_s).squaredNorm();
    samples_.push_back({{state.position_m, tiltedBy(smooth)}, smooth, distance_m});
}

FlightTrace::Place FlightTrace::placeOf(double time_s) const {
    const auto last = static_cast<double>(samples_.size() - 1);
    const double at = std::clamp(time_s / kControlStep_s, 0.0, last);
    const auto before = static_cast<std::size_t>(at);
    const std::size_t after = std::min(before + 1, samples_.size() - 1);
    return {samples_[before], samples_[after], at - static_cast<double>(before)};
}

simulation::SensorPose FlightTrace::at(double time_s) const {
    const Place place = placeOf(time_s);
    const simulation::SensorPose &a = place.before.pose, &b = place.after.pose;
    return {a.position_m + place.share * (b.position_m - a.position_m),
            a.attitude.slerp(place.share, b.attitude)};
}

double FlightTrace::distance_m(double time_s) const {
    const Place place = placeOf(time_s);
    return place.before.distance_m +
           place.share * (place.after.distance_m - place.before.distance_m);
}

double FlightTrace::rmsJerk_m_s3() const {
    const std::size_t steps = samples_.size() - 1;
    return steps == 0 ? 0 : std::sqrt(squared_jerk_ / static_cast<double>(steps));
}

}  // namespace hagen::avoidance
