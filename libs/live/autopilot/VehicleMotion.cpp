#include "live/autopilot/VehicleMotion.h"
#include "live/autopilot/Messages.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hagen::live {
namespace {

constexpr double kKept_s = 2;
constexpr double kStale_s = 0.5;
constexpr double kTurnOn_s = 0.1, kMoveOn_s = 0.2;
constexpr double kJump_m = 2;  // maximum deviation of the position from its prediction
constexpr double kNormError = 0.05;

/// Converts forward-right-down to forward-left-up, and north-east-down to north-west-up.
Eigen::Vector3d flipped(double x, double y, double z) { return {x, -y, -z}; }

Eigen::Quaterniond turnBy(const Eigen::Vector3d& rotation_rad) {
    const double angle_rad = rotation_rad.norm();
    if (angle_rad < 1e-12) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, rotation_rad / angle_rad));
}

// No multirotor exceeds these speeds, and no gyroscope measures such rates. At higher speeds,
// moving an obstacle to another direction could make its direction free.
constexpr double kMaxAngle_rad = 10, kMaxRate_rad_s = 50;
constexpr double kMaxCoordinate_m = 1e7, kMaxSpeed_m_s = 100;

/// Whether all values are in range; false for NaN.
template <class... Value>
bool areWithin(double max, Value... values) {
    return ((std::abs(static_cast<double>(values)) <= max) && ...);
}

template <class Sample>
void forget(std::deque<Sample>& samples) {
    while (samples.back().time_s - samples.front().time_s > kKept_s) samples.pop_front();
}

template <class Sample>
auto after(const std::deque<Sample>& samples, double time_s) {
    return std::upper_bound(samples.begin(), samples.end(), time_s,
                            [](double wanted, const Sample& s) { return wanted < s.time_s; });
}

}  // namespace

double VehicleMotion::ourTime(std::uint32_t boot_ms, double arrival_s) {
    const auto result = clock_.ourTime(1e-3 * boot_ms, arrival_s);
    if (result.has_restarted) {
        ++restarts_;
        attitudes_.clear();
        places_.clear();
    }
    return result.time_s;
}

/// Ignores late samples, and samples repeated by the other attitude message.
void VehicleMotion::add(const Attitude& attitude) {
    if (!attitudes_.empty() && attitude.time_s <= attitudes_.back().time_s) return;
    attitudes_.push_back(attitude);
    forget(attitudes_);
}

void VehicleMotion::add(Place place) {
    place.place_m += origin_m_;
    if (!places_.empty()) {
        const Place& last = places_.back();
        const double passed_s = place.time_s - last.time_s;
        if (passed_s <= 0) return;
        const Eigen::Vector3d jump_m = place.place_m - last.place_m - passed_s * last.speed_m_s;
        if (passed_s > kStale_s) {
            places_.clear();  // the position estimate may have jumped meanwhile
        } else if (jump_m.norm() > kJump_m) {
            origin_m_ -= jump_m;
            place.place_m -= jump_m;
        }
    }
    places_.push_back(place);
    forget(places_);
}

VehicleMotion::Taken VehicleMotion::take(const mavlink::Frame& frame, double arrival_s) {
    if (const auto m = mavlink::messageOf<mavlink::Attitude>(frame)) {
        if (!areWithin(kMaxAngle_rad, m->roll, m->pitch, m->yaw) ||
            !areWithin(kMaxRate_rad_s, m->rollspeed, m->pitchspeed, m->yawspeed)) {
            return Taken::Refused;
        }
        using Eigen::AngleAxisd;
        using Eigen::Vector3d;
        const Eigen::Quaterniond turn = AngleAxisd(-m->yaw, Vector3d::UnitZ()) *
                                        AngleAxisd(-m->pitch, Vector3d::UnitY()) *
                                        AngleAxisd(m->roll, Vector3d::UnitX());
        add({ourTime(m->time_boot_ms, arrival_s), turn,
             flipped(m->rollspeed, m->pitchspeed, m->yawspeed)});
        return Taken::Attitude;
    }
    if (const auto m = mavlink::messageOf<mavlink::AttitudeQuaternion>(frame)) {
        if (!areWithin(2, m->q1, m->q2, m->q3, m->q4) ||
            !areWithin(kMaxRate_rad_s, m->rollspeed, m->pitchspeed, m->yawspeed)) {
            return Taken::Refused;
        }
        // The vector part of a quaternion is flipped like other vectors.
        const Eigen::Quaterniond turn(m->q1, m->q2, -m->q3, -m->q4);
        if (std::abs(turn.norm() - 1) > kNormError) return Taken::Refused;
        add({ourTime(m->time_boot_ms, arrival_s), turn.normalized(),
             flipped(m->rollspeed, m->pitchspeed, m->yawspeed)});
        return Taken::Attitude;
    }
    if (const auto m = mavlink::messageOf<mavlink::LocalPositionNed>(frame)) {
        if (!areWithin(kMaxCoordinate_m, m->x, m->y, m->z) ||
            !areWithin(kMaxSpeed_m_s, m->vx, m->vy, m->vz)) {
            return Taken::Refused;
        }
        add({ourTime(m->time_boot_ms, arrival_s), flipped(m->x, m->y, m->z),
             flipped(m->vx, m->vy, m->vz)});
        return Taken::Place;
    }
    return Taken::Other;
}

void VehicleMotion::placeAt(double time_s, VehiclePose& pose) const {
    const auto next = after(places_, time_s);
    if (next == places_.begin()) return;
    const Place& last = *std::prev(next);
    const double passed_s = time_s - last.time_s;
    if (passed_s > kStale_s) return;
    if (next != places_.end()) {
        const double share = passed_s / (next->time_s - last.time_s);
        pose.place_m = last.place_m + share * (next->place_m - last.place_m);
    } else {
        pose.place_m = last.place_m + std::min(passed_s, kMoveOn_s) * last.speed_m_s;
    }
}

std::optional<VehiclePose> VehicleMotion::at(double time_s) const {
    const auto next = after(attitudes_, time_s);
    if (next == attitudes_.begin()) return std::nullopt;
    const Attitude& last = *std::prev(next);
    const double passed_s = time_s - last.time_s;
    if (passed_s > kStale_s) return std::nullopt;
    VehiclePose pose;
    if (next != attitudes_.end()) {
        const double share = passed_s / (next->time_s - last.time_s);
        pose.map_from_vehicle = last.map_from_vehicle.slerp(share, next->map_from_vehicle);
    } else {
        pose.map_from_vehicle =
            last.map_from_vehicle * turnBy(std::min(passed_s, kTurnOn_s) * last.rates_rad_s);
    }
    placeAt(time_s, pose);
    return pose;
}

}  // namespace hagen::live
