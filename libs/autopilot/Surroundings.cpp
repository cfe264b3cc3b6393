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
    if (!sector.sweep) {
        seen.is_all_around = frames_.add(sector.first_time_s, sector.measured_s);
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

/// How it looked in a direction of the sensor's frame. The gap before a packet is passed with it;
/// the direction just behind it is near enough to be seen, but not passed.
Surroundings::Look Surroundings::lookOf(const Seen& seen, const Eigen::Vector3d& ahead) const {
    if (ahead.z() < lowest_ || ahead.z() > highest_) return Look::None;
    if (seen.sweeps.empty()) return seen.is_all_around ? Look::Passed : Look::None;
    const double clockwise_rad = -std::atan2(ahead.y(), ahead.x());
    Look look = Look::None;
    for (const streaming::Sweep& sweep : seen.sweeps) {
        const double into_rad = clockwise_rad - sweep.from_rad + kTolerance_rad;
        const double turned_rad = into_rad - kTurn_rad * std::floor(into_rad / kTurn_rad);
        const double width_rad = sweep.to_rad - sweep.from_rad + kTolerance_rad;
        if (turned_rad <= width_rad) return Look::Passed;
        if (turned_rad <= width_rad + kTolerance_rad) look = Look::Near;
    }
    return look;
}

Directions Surroundings::at(double now_s, const VehicleMotion& motion) const {
    // Of the edges between bins: whether the sensor looked there, and how far it had turned when it
    // passed them last.
    std::array<bool, kBins> is_seen{}, is_passed{};
    std::array<double, kBins> passed_rad;
    passed_rad.fill(-kNone);
    Directions directions;
    const std::optional<VehiclePose> now = motion.at(now_s);
    constexpr double kPart_rad = kTurn_rad / kBins, kHalf_rad = kTurn_rad / 72 / 2;

    for (auto each = seen_.rbegin(); each != seen_.rend(); ++each) {
        const Seen* const seen = each->get();
        if (!isFresh(*seen, now_s)) continue;
        // All was swept again, by a later turn.
        const double least_rad = *std::min_element(passed_rad.begin(), passed_rad.end());
        if (least_rad - seen->to_rad > kPi) continue;
        const auto then = motion.at((seen->first_time_s + seen->last_time_s) / 2);
        const Eigen::Isometry3d level = levelFromSensor(settings_.vehicle_from_sensor, then, now);
        const Eigen::Matrix3d sensor_from_level = level.linear().transpose();
        for (int edge = 0; edge < kBins; ++edge) {
            if (is_passed[edge]) continue;
            const double clockwise_rad = edge * kPart_rad - kHalf_rad;
            const Eigen::Vector3d ahead(std::cos(clockwise_rad), -std::sin(clockwise_rad), 0);
            const Look look = lookOf(*seen, sensor_from_level * ahead);
            is_seen[edge] = is_seen[edge] || look != Look::None;
            if (look != Look::Passed) continue;
            is_passed[edge] = true;
            passed_rad[edge] = seen->to_rad;
        }
        const Eigen::Isometry3f move = level.cast<float>();
        for (const Eigen::Vector3f& roi_m : seen->roi_m) {
            const Eigen::Vector3f at_m = move * roi_m;
            if (!(std::abs(at_m.z()) <= settings_.height_m)) continue;
            double clockwise_rad = kHalf_rad - static_cast<double>(std::atan2(at_m.y(), at_m.x()));
            clockwise_rad -= kTurn_rad * std::floor(clockwise_rad / kTurn_rad);
            const int bin = std::min(static_cast<int>(clockwise_rad / kPart_rad), kBins - 1);
            // The next turn has passed all of the bin since, without this.
            const double since_rad = std::min(passed_rad[bin], passed_rad[(bin + 1) % kBins]);
            if (since_rad - seen->to_rad > kPi) continue;
            Direction& direction = directions[bin / kParts];
            const float distance_m = at_m.head<2>().norm();
            if (direction.distance_m <= distance_m) continue;
            direction = {Direction::State::Obstacle, distance_m, at_m};
        }
    }
    for (int k = 0; k < 72; ++k) {
        bool is_all = true;
        for (int edge = k * kParts; edge <= (k + 1) * kParts; ++edge) {
            is_all = is_all && is_seen[edge % kBins];
        }
        Direction& direction = directions[k];
        if (direction.state == Direction::State::Unknown && is_all) {
            direction.state = Direction::State::SeenNothing;
        }
    }
    return directions;
}

}  // namespace hagen::autopilot
