#include <hagen/autopilot/Surroundings.h>
#include <hagen/range_image/Angle.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hagen::autopilot {
namespace {

constexpr double kTurn_rad = 2 * kPi;
// Packets begin and end between the firings, and beams have a width.
constexpr double kTolerance_rad = 0.005;
// A sensor without turns looks all around within half of this time.
constexpr double kFrames_s = 0.2;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// From the sensor's frame to the vehicle's level one of now.
Eigen::Isometry3d levelFromSensor(const Eigen::Matrix3d& vehicle_from_sensor,
                                  const std::optional<VehiclePose>& then,
                                  const std::optional<VehiclePose>& now) {
    Eigen::Isometry3d level = Eigen::Isometry3d::Identity();
    level.linear() = vehicle_from_sensor;
    if (!then) return level;
    level.linear() = levelFromVehicle(*then) * vehicle_from_sensor;
    if (now) level = levelBetween(*then, *now) * level;
    return level;
}

}  // namespace

Surroundings::Surroundings(const SensorModel& sensor, const Settings& settings)
    : settings_(settings),
      lowest_(std::sin(static_cast<double>(sensor.elevations_rad.front()))),
      highest_(std::sin(static_cast<double>(sensor.elevations_rad.back()))) {}

void Surroundings::take(const streaming::LabelledSector& sector) {
    Seen seen;
    seen.first_time_s = sector.first_time_s;
    seen.last_time_s = sector.last_time_s;
    seen.to_rad = sector.sweep ? sector.sweep->to_rad : 0;
    if (sector.sweep && sector.packets) seen.sweeps = *sector.packets;
    if (sector.sweep && !sector.packets) seen.sweeps.push_back(*sector.sweep);
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        seen.roi_m.emplace_back(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    const bool went_back = !seen_.empty() && sector.first_time_s < seen_.back()->first_time_s;
    if (went_back) seen_.clear();
    latest_s_ = went_back ? sector.last_time_s : std::max(latest_s_, sector.last_time_s);
    while (!seen_.empty() && !isFresh(*seen_.front(), sector.last_time_s)) seen_.pop_front();
    seen_.push_back(std::make_shared<const Seen>(std::move(seen)));
}

bool Surroundings::isFresh(const Seen& seen, double now_s) const {
    const double age_s = now_s - seen.first_time_s;
    const double longest_s =
        seen.sweeps.empty() ? std::min(kFrames_s, settings_.stale_s) : settings_.stale_s;
    return age_s >= 0 && age_s <= longest_s;
}

/// Whether it looked in a direction of the sensor's frame.
bool Surroundings::covers(const Seen& seen, const Eigen::Vector3d& ahead) const {
    if (ahead.z() < lowest_ || ahead.z() > highest_) return false;
    if (seen.sweeps.empty()) return true;
    const double clockwise_rad = -std::atan2(ahead.y(), ahead.x());
    return std::any_of(seen.sweeps.begin(), seen.sweeps.end(), [&](const streaming::Sweep& sweep) {
        const double into_rad = clockwise_rad - sweep.from_rad + kTolerance_rad;
        const double turned_rad = into_rad - kTurn_rad * std::floor(into_rad / kTurn_rad);
        return turned_rad <= sweep.to_rad - sweep.from_rad + 2 * kTolerance_rad;
    });
}

Directions Surroundings::at(double now_s, const VehicleMotion& motion) const {
    // How far the sensor had turned when it swept each part last.
    std::array<double, kBins> swept_rad;
    swept_rad.fill(-kNone);
    std::array<bool, kBins> is_swept{};
    Directions directions;
    const std::optional<VehiclePose> now = motion.at(now_s);
    constexpr double kPart_rad = kTurn_rad / kBins, kHalf_rad = kTurn_rad / 72 / 2;

    for (auto each = seen_.rbegin(); each != seen_.rend(); ++each) {
        const Seen* const seen = each->get();
        if (!isFresh(*seen, now_s)) continue;
        // All was swept again, by a later turn.
        const double least_rad = *std::min_element(swept_rad.begin(), swept_rad.end());
        if (least_rad - seen->to_rad > kPi) continue;
        const auto then = motion.at((seen->first_time_s + seen->last_time_s) / 2);
        const Eigen::Isometry3d level = levelFromSensor(settings_.vehicle_from_sensor, then, now);
        const Eigen::Matrix3d sensor_from_level = level.linear().transpose();
        for (int bin = 0; bin < kBins; ++bin) {
            if (is_swept[bin]) continue;
            const double clockwise_rad = (bin + 0.5) * kPart_rad - kHalf_rad;
            const Eigen::Vector3d ahead(std::cos(clockwise_rad), -std::sin(clockwise_rad), 0);
            if (!covers(*seen, sensor_from_level * ahead)) continue;
            is_swept[bin] = true;
            swept_rad[bin] = seen->to_rad;
        }
        const Eigen::Isometry3f move = level.cast<float>();
        for (const Eigen::Vector3f& roi_m : seen->roi_m) {
            const Eigen::Vector3f at_m = move * roi_m;
            if (!(std::abs(at_m.z()) <= settings_.height_m)) continue;
            double clockwise_rad = kHalf_rad - static_cast<double>(std::atan2(at_m.y(), at_m.x()));
            clockwise_rad -= kTurn_rad * std::floor(clockwise_rad / kTurn_rad);
            const int bin = std::min(static_cast<int>(clockwise_rad / kPart_rad), kBins - 1);
            // The next turn has swept it since, without this.
            if (swept_rad[bin] - seen->to_rad > kPi) continue;
            Direction& direction = directions[bin / kParts];
            const float distance_m = at_m.head<2>().norm();
            if (direction.distance_m <= distance_m) continue;
            direction = {Direction::State::Obstacle, distance_m, at_m};
        }
    }
    for (int k = 0; k < 72; ++k) {
        const auto first = is_swept.begin() + k * kParts;
        const bool is_all = std::all_of(first, first + kParts, [](bool is) { return is; });
        Direction& direction = directions[k];
        if (direction.state == Direction::State::Unknown && is_all) {
            direction.state = Direction::State::SeenNothing;
        }
    }
    return directions;
}

}  // namespace hagen::autopilot
