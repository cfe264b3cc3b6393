#include <hagen/autopilot/Surroundings.h>
#include <hagen/range_image/Angle.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hagen::autopilot {

using streaming::TurnCoverage;

namespace {

constexpr double kTurn_rad = 2 * kPi;
constexpr double kNone = std::numeric_limits<double>::infinity();
// How long an obstacle is in doubt where packets are lost again and again.
constexpr double kLongestDoubt_s = 0.7;
constexpr double kPart_rad = kTurn_rad / 360, kHalf_rad = kTurn_rad / 72 / 2;

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

/// Of a direction, clockwise from ahead; the first degree begins so much before that.
int degreeOf(const Eigen::Vector2f& at_m, double before_rad) {
    double clockwise_rad = before_rad - static_cast<double>(std::atan2(at_m.y(), at_m.x()));
    clockwise_rad -= kTurn_rad * std::floor(clockwise_rad / kTurn_rad);
    return std::min(static_cast<int>(clockwise_rad / kPart_rad), 359);
}

}  // namespace

Surroundings::Surroundings(const SensorModel& sensor, const Settings& settings)
    : settings_(settings),
      lowest_(std::sin(static_cast<double>(sensor.elevations_rad.front()))),
      highest_(std::sin(static_cast<double>(sensor.elevations_rad.back()))) {}

void Surroundings::take(const streaming::LabelledSector& sector) {
    const bool went_back = !seen_.empty() && sector.first_time_s < seen_.back()->first_time_s;
    if (went_back) {
        seen_.clear();
        coverage_.clear();
        all_around_since_s_ = -kNone;
    }
    Seen seen;
    seen.first_time_s = sector.first_time_s;
    seen.last_time_s = sector.last_time_s;
    seen.turns = sector.sweep.has_value();
    if (seen.turns) {
        seen.swept = coverage_.add(sector);
        seen.ahead_rad = sector.offsets.ahead_rad;
        seen.from_rad = coverage_.before_rad();
        seen.to_rad = coverage_.head_rad();
    }
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        seen.roi_m.emplace_back(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    if (!sector.sweep) {
        seen.all_around_since_s =
            frames_.add(sector.first_time_s, sector.measured_s, sector.sensor_time_s);
        all_around_since_s_ = seen.all_around_since_s.value_or(all_around_since_s_);
    }
    latest_s_ = went_back ? sector.last_time_s : std::max(latest_s_, sector.last_time_s);
    while (!seen_.empty() && !matters(*seen_.front(), sector.last_time_s)) seen_.pop_front();
    seen_.push_back(std::make_shared<const Seen>(std::move(seen)));
}

bool Surroundings::isFresh(const Seen& seen, double now_s) const {
    const double age_s = now_s - seen.first_time_s;
    return age_s >= 0 && age_s <= settings_.stale_s && matters(seen, now_s);
}

/// Whether it may be used, or what it saw makes directions unknown: the sensor has not looked there
/// again, and growing old makes no obstacle free.
bool Surroundings::matters(const Seen& seen, double now_s) const {
    constexpr double kForgotten_s = streaming::FrameCoverage::kForgotten_s;
    const double age_s = now_s - seen.first_time_s;
    if (seen.turns) return age_s >= 0 && age_s <= settings_.stale_s + kLongestDoubt_s;
    const double looked_again_s = all_around_since_s_ - seen.first_time_s;
    return age_s >= 0 && age_s <= settings_.stale_s + kForgotten_s &&
           looked_again_s <= kForgotten_s;
}

/// Where the sensor, as it was then, saw an edge between two degrees; NaN: it did not.
double Surroundings::azimuthOf(const Eigen::Matrix3d& sensor_from_level, int edge) const {
    static const auto directions = [] {
        std::array<Eigen::Vector3d, kBins + 1> all;
        for (int e = 0; e <= kBins; ++e) {
            const double clockwise_rad = e * kPart_rad - kHalf_rad;
            all[e] = {std::cos(clockwise_rad), -std::sin(clockwise_rad), 0};
        }
        return all;
    }();
    const Eigen::Vector3d ahead = sensor_from_level * directions[edge];
    const bool is_seen = ahead.z() >= lowest_ && ahead.z() <= highest_;
    return is_seen ? -std::atan2(ahead.y(), ahead.x()) : std::nan("");
}

/// How far a sensor had turned at the end of an arc, if all of it was swept by the time of this
/// sector, and nothing of it before the head had turned to `since_rad`: that is too old.
std::optional<double> Surroundings::passedAt(const Seen& seen, const TurnCoverage::Arc& arc,
                                             double since_rad) {
    std::optional<double> passed_rad;
    if (!seen.turns) {
        if (!std::isnan(arc.begin_rad)) passed_rad = seen.to_rad;
        return passed_rad;
    }
    for (TurnCoverage::Swept swept : seen.swept) {
        swept.since_rad = std::max(swept.since_rad, since_rad + seen.ahead_rad);
        if (const auto end_rad = endOfArc(swept, arc)) {
            passed_rad = std::max(*end_rad, passed_rad.value_or(*end_rad));
        }
    }
    return passed_rad;
}

/// The same of the sensor's degrees, which it has yawed away from since then.
void Surroundings::notePassed(const Seen& seen, double yawed_rad, double since_rad,
                              std::array<double, kBins>& passed_rad) {
    if (!seen.turns) {
        for (double& rad : passed_rad) rad = std::max(rad, seen.to_rad);
        return;
    }
    for (TurnCoverage::Swept swept : seen.swept) {
        swept.since_rad = std::max(swept.since_rad, since_rad + seen.ahead_rad);
        // The others do not end within it.
        const double last = std::ceil((swept.to_rad - yawed_rad) / kPart_rad);
        const double first = std::floor((swept.from_rad - yawed_rad) / kPart_rad) - 1;
        for (double k = std::max(first, last - kBins); k < last; ++k) {
            const TurnCoverage::Arc arc{k * kPart_rad + yawed_rad, kPart_rad};
            const auto end_rad = endOfArc(swept, arc);
            const double degree = k - kBins * std::floor(k / kBins);
            double& rad = passed_rad[static_cast<std::size_t>(degree)];
            if (end_rad) rad = std::max(rad, *end_rad);
        }
    }
}

Directions Surroundings::at(double now_s, const VehicleMotion& motion) const {
    // How far the sensor had turned when it passed a degree last.
    std::array<double, kBins> passed_rad;
    passed_rad.fill(-kNone);
    // The same of the degrees of the sensor as it is now. When it is tilted, it looks at what is
    // below the horizon and at the horizon straight above that at different times.
    std::array<double, kBins> passed_by_sensor_rad;
    passed_by_sensor_rad.fill(-kNone);
    Directions directions;
    if (now_s < latest_s_ - settings_.stale_s) return directions;  // a clock that went back
    std::array<bool, 72> is_doubtful{};  // an obstacle was there, and nobody has looked again
    const std::optional<VehiclePose> now = motion.at(now_s);
    double fresh_rad = kNone;  // what it swept before is stale
    for (const auto& seen : seen_) {
        if (isFresh(*seen, now_s)) fresh_rad = std::min(fresh_rad, seen->from_rad);
    }
    for (auto each = seen_.rbegin(); each != seen_.rend(); ++each) {
        const Seen* const seen = each->get();
        if (!matters(*seen, now_s)) continue;
        const bool is_fresh = isFresh(*seen, now_s);
        // All was swept again, by a later turn. Without the horizon no direction is free, so that
        // there are no doubts.
        const auto areAllPassed = [&](const std::array<double, kBins>& all_rad) {
            const double least_rad = *std::min_element(all_rad.begin(), all_rad.end());
            return least_rad - seen->to_rad > streaming::kLaterTurn_rad;
        };
        if (areAllPassed(passed_by_sensor_rad) && (!is_fresh || areAllPassed(passed_rad))) continue;
        const auto then = motion.at((seen->first_time_s + seen->last_time_s) / 2);
        const Eigen::Isometry3d level = levelFromSensor(settings_.vehicle_from_sensor, then, now);
        // What was seen since is at least as fresh.
        const bool is_swept = seen->turns
                                  ? is_fresh
                                  : (seen->all_around_since_s &&
                                     now_s - *seen->all_around_since_s <= settings_.stale_s);
        const Eigen::Matrix3d sensor_from_level = level.linear().transpose();
        Eigen::Matrix3d now_from_level = sensor_from_level;
        if (now) {
            now_from_level = (levelFromVehicle(*now) * settings_.vehicle_from_sensor).transpose();
        }
        const Eigen::Matrix3f sensor_from_level_now = now_from_level.cast<float>();
        const Eigen::Vector3d ahead_then = now_from_level * level.linear().col(0);
        const double yawed_rad = std::atan2(ahead_then.y(), ahead_then.x());
        if (is_swept) notePassed(*seen, yawed_rad, fresh_rad, passed_by_sensor_rad);
        double next_rad = 0;
        int next = -1;  // the edge of which this is the azimuth
        for (int bin = 0; bin < kBins && is_swept; ++bin) {
            if (passed_rad[bin] > -kNone) continue;
            const double begin_rad = next == bin ? next_rad : azimuthOf(sensor_from_level, bin);
            next = bin + 1;
            next_rad = azimuthOf(sensor_from_level, next);
            const auto arc = TurnCoverage::between(begin_rad, next_rad);
            passed_rad[bin] = passedAt(*seen, arc, fresh_rad).value_or(-kNone);
        }
        const Eigen::Isometry3f move = level.cast<float>();
        const auto isPassed = [&](double at_rad) {
            return at_rad - seen->to_rad > streaming::kLaterTurn_rad;
        };
        for (const Eigen::Vector3f& roi_m : seen->roi_m) {
            const Eigen::Vector3f at_m = move * roi_m;
            if (!(std::abs(at_m.z()) <= settings_.height_m)) continue;
            const int bin = degreeOf(at_m.head<2>(), kHalf_rad);
            // The next turn has passed it since, without this.
            if (isPassed(passed_rad[bin])) {
                const Eigen::Vector2f from_sensor_m = (sensor_from_level_now * at_m).head<2>();
                if (isPassed(passed_by_sensor_rad[degreeOf(from_sensor_m, 0)])) continue;
            }
            if (!is_fresh) {
                is_doubtful[bin / kParts] = true;
                continue;
            }
            Direction& direction = directions[bin / kParts];
            const float distance_m = at_m.head<2>().norm();
            if (direction.distance_m <= distance_m) continue;
            direction = {Direction::State::Obstacle, distance_m, at_m};
        }
    }
    for (int k = 0; k < 72; ++k) {
        bool is_all = !is_doubtful[k];
        for (int bin = k * kParts; bin < (k + 1) * kParts; ++bin) {
            is_all = is_all && passed_rad[bin] > -kNone;
        }
        Direction& direction = directions[k];
        if (direction.state == Direction::State::Unknown && is_all) {
            direction.state = Direction::State::SeenNothing;
        }
    }
    return directions;
}

}  // namespace hagen::autopilot
