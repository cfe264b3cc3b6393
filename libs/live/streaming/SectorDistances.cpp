#include <hagen/live/SectorDistances.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hagen::live {
namespace {

constexpr double kPart_rad = kTurn_rad / 360;
// Maximum time for which an obstacle is doubtful if packets keep getting lost.
constexpr double kMaxDoubt_s = 0.7;

/// The swept directions without the stale part before `since_rad`.
TurnCoverage::Swept freshPart(TurnCoverage::Swept swept, double since_rad) {
    swept.since_rad = std::max(swept.since_rad, since_rad);
    return swept;
}

/// The sensor's rotation when a sweep last completed an arc; nullopt if none did.
std::optional<double> lastEndOfArc(const std::vector<TurnCoverage::Swept>& all, double since_rad,
                                   const TurnCoverage::Arc& arc) {
    std::optional<double> last_rad;
    for (const TurnCoverage::Swept& swept : all) {
        const auto end_rad = endOfArc(freshPart(swept, since_rad), arc);
        if (end_rad) last_rad = std::max(*end_rad, last_rad.value_or(*end_rad));
    }
    return last_rad;
}

}  // namespace

int directionOf(const Eigen::Vector2f& at_m, int number, double begin_rad) {
    double clockwise_rad = -begin_rad - static_cast<double>(std::atan2(at_m.y(), at_m.x()));
    clockwise_rad -= kTurn_rad * std::floor(clockwise_rad / kTurn_rad);
    return std::min(static_cast<int>(clockwise_rad / (kTurn_rad / number)), number - 1);
}

/// Intermediate results of at(), from the newest sector to the oldest.
struct SectorDistances::Look {
    double now_s;
    const PoseAt& pose_at;
    std::optional<VehiclePose> now;
    double fresh_rad = std::numeric_limits<double>::infinity();  ///< earlier sweeps are stale
    /// For each degree of the vehicle, the sensor's rotation when it last passed, and the arrival
    /// time of that sector.
    std::array<double, kBins> passed_rad, passed_s{};
    /// Like passed_rad, but for each degree of the current sensor frame. A tilted sensor looks
    /// below the horizon and at the horizon straight above at different times.
    std::array<double, kBins> passed_by_sensor_rad;
    std::array<bool, kSectors> is_doubtful{};  ///< unconfirmed old obstacle
    Sectors sectors;

    Look(double time_s, const PoseAt& pose) : now_s(time_s), pose_at(pose), now(poseAt(time_s)) {
        passed_rad.fill(kNever);
        passed_by_sensor_rad.fill(kNever);
    }
    std::optional<VehiclePose> poseAt(double time_s) const {
        return pose_at ? pose_at(time_s) : std::nullopt;
    }
};

/// Transforms for a sector.
struct SectorDistances::Frames {
    Eigen::Isometry3d level_from_sensor;      ///< from the sensor frame of the past sector
    Eigen::Isometry3d level_from_sensor_now;  ///< from the current sensor frame
    double yawed_rad;                         ///< yaw of the sensor since the sector
};

SectorDistances::SectorDistances(const SensorModel& sensor, const Settings& settings)
    : settings_(settings),
      lowest_(std::sin(static_cast<double>(sensor.elevations_rad.front()))),
      highest_(std::sin(static_cast<double>(sensor.elevations_rad.back()))) {}

void SectorDistances::take(const LabelledSector& sector) {
    const bool went_back = !seen_.empty() && sector.first_time_s < seen_.back()->first_time_s;
    if (went_back) {
        seen_.clear();
        coverage_.clear();
        all_around_since_s_ = kNever;
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
    } else {
        seen.all_around_since_s =
            frames_.add(sector.first_time_s, sector.measured_s, sector.sensor_time_s);
        all_around_since_s_ = seen.all_around_since_s.value_or(all_around_since_s_);
    }
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        seen.roi_m.emplace_back(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    latest_s_ = went_back ? sector.last_time_s : std::max(latest_s_, sector.last_time_s);
    while (!seen_.empty() && !matters(*seen_.front(), sector.last_time_s)) seen_.pop_front();
    seen_.push_back(std::make_shared<const Seen>(std::move(seen)));
}

bool SectorDistances::isFresh(const Seen& seen, double now_s) const {
    const double age_s = now_s - seen.first_time_s;
    return age_s >= 0 && age_s <= settings_.stale_s && matters(seen, now_s);
}

/// Whether a sector is still used. Old obstacles make directions unknown, never free, until the
/// sensor looks again.
bool SectorDistances::matters(const Seen& seen, double now_s) const {
    constexpr double kForgotten_s = FrameCoverage::kForgotten_s;
    const double age_s = now_s - seen.first_time_s;
    if (seen.turns) return age_s >= 0 && age_s <= settings_.stale_s + kMaxDoubt_s;
    const double looked_again_s = all_around_since_s_ - seen.first_time_s;
    return age_s >= 0 && age_s <= settings_.stale_s + kForgotten_s &&
           looked_again_s <= kForgotten_s;
}

SectorDistances::Frames SectorDistances::framesOf(const Seen& seen, const Look& look) const {
    const auto levelFromSensorAt = [&](const VehiclePose& pose) {
        Eigen::Isometry3d level = Eigen::Isometry3d::Identity();
        level.linear() = levelFromVehicle(pose);
        return level * settings_.body_from_sensor;
    };
    Frames frames{settings_.body_from_sensor, {}, 0};
    const auto then = look.poseAt((seen.first_time_s + seen.last_time_s) / 2);
    if (then) frames.level_from_sensor = levelFromSensorAt(*then);
    if (then && look.now) {
        frames.level_from_sensor = levelBetween(*then, *look.now) * frames.level_from_sensor;
    }
    frames.level_from_sensor_now =
        look.now ? levelFromSensorAt(*look.now) : frames.level_from_sensor;
    const Eigen::Vector3d ahead_then = frames.level_from_sensor_now.linear().transpose() *
                                       frames.level_from_sensor.linear().col(0);
    frames.yawed_rad = std::atan2(ahead_then.y(), ahead_then.x());
    return frames;
}

/// The azimuth at which the sensor then saw an edge between two degrees; NaN if outside its beams.
double SectorDistances::azimuthOf(const Eigen::Matrix3d& sensor_from_level, int edge) const {
    const double clockwise_rad = edge * kPart_rad + settings_.begin_rad;
    const Eigen::Vector3d ahead =
        sensor_from_level * Eigen::Vector3d(std::cos(clockwise_rad), -std::sin(clockwise_rad), 0);
    const bool is_seen = ahead.z() >= lowest_ && ahead.z() <= highest_;
    return is_seen ? -std::atan2(ahead.y(), ahead.x()) : std::nan("");
}

/// Arrival of the sector in which a beam first looked at an angle of the turning sensor.
double SectorDistances::firstLook_s(double rad) const {
    constexpr double kRounding_rad = 1e-5;
    const auto isBefore = [&](const std::shared_ptr<const Seen>& seen) {
        return seen->to_rad + seen->ahead_rad <= rad + kRounding_rad;
    };
    const auto first = std::partition_point(seen_.begin(), seen_.end(), isBefore);
    return first == seen_.end() ? seen_.back()->first_time_s : (*first)->first_time_s;
}

/// Records the degrees of the vehicle that a sector has completely swept at the horizon, without
/// stale parts, unless a later sector has swept them, too.
void SectorDistances::noteHorizon(const Seen& seen, const Frames& frames, Look& look) const {
    const Eigen::Matrix3d sensor_from_level = frames.level_from_sensor.linear().transpose();
    double next_rad = 0;
    int next = -1;  // edge whose azimuth is next_rad
    for (int bin = 0; bin < kBins; ++bin) {
        if (look.passed_rad[bin] > kNever) continue;
        const double begin_rad = next == bin ? next_rad : azimuthOf(sensor_from_level, bin);
        next = bin + 1;
        next_rad = azimuthOf(sensor_from_level, next);
        const auto arc = TurnCoverage::between(begin_rad, next_rad);
        std::optional<double> passed_rad;
        if (seen.turns) {
            passed_rad = lastEndOfArc(seen.swept, look.fresh_rad + seen.ahead_rad, arc);
        } else if (!std::isnan(arc.begin_rad)) {
            passed_rad = seen.to_rad;
        }
        if (!passed_rad) continue;
        look.passed_rad[bin] = *passed_rad;
        look.passed_s[bin] =
            seen.turns ? firstLook_s(*passed_rad - arc.width_rad) : *seen.all_around_since_s;
    }
}

/// Like noteHorizon(), but for the sensor's degrees, corrected for its yaw since then.
void SectorDistances::noteSensor(const Seen& seen, const Frames& frames, Look& look) {
    if (!seen.turns) {
        for (double& rad : look.passed_by_sensor_rad) rad = std::max(rad, seen.to_rad);
        return;
    }
    for (const TurnCoverage::Swept& swept : seen.swept) {
        // Skips degrees that do not end within this sweep.
        const double last = std::ceil((swept.to_rad - frames.yawed_rad) / kPart_rad);
        const double first = std::floor((swept.from_rad - frames.yawed_rad) / kPart_rad) - 1;
        for (double k = std::max(first, last - kBins); k < last; ++k) {
            const TurnCoverage::Arc arc{k * kPart_rad + frames.yawed_rad, kPart_rad};
            const auto end_rad = endOfArc(freshPart(swept, look.fresh_rad + seen.ahead_rad), arc);
            const double degree = k - kBins * std::floor(k / kBins);
            double& rad = look.passed_by_sensor_rad[static_cast<std::size_t>(degree)];
            if (end_rad) rad = std::max(rad, *end_rad);
        }
    }
}

/// Adds the obstacles of a sector, unless a later turn has passed them without detection.
void SectorDistances::addObstacles(const Seen& seen, const Frames& frames, Look& look) const {
    const bool is_fresh = isFresh(seen, look.now_s);
    const Eigen::Isometry3f move = frames.level_from_sensor.cast<float>();
    const Eigen::Isometry3f sensor_from_level =
        frames.level_from_sensor_now.inverse().cast<float>();
    for (const Eigen::Vector3f& roi_m : seen.roi_m) {
        const Eigen::Vector3f at_m = move * roi_m;
        if (!(at_m.z() >= settings_.low_m && at_m.z() <= settings_.high_m)) continue;
        const int bin = directionOf(at_m.head<2>(), kBins, settings_.begin_rad);
        if (seen.isPassed(look.passed_rad[bin])) {
            const Eigen::Vector2f from_sensor_m = (sensor_from_level * at_m).head<2>();
            const int degree = directionOf(from_sensor_m, kBins);
            if (seen.isPassed(look.passed_by_sensor_rad[degree])) continue;
        }
        if (!is_fresh) {
            look.is_doubtful[bin / kParts] = true;
            continue;
        }
        Sector& sector = look.sectors[bin / kParts];
        const float distance_m = at_m.head<2>().norm();
        const bool is_first = sector.state != State::Obstacle;
        sector.state = State::Obstacle;
        sector.time_s = is_first ? seen.first_time_s : std::min(sector.time_s, seen.first_time_s);
        if (sector.distance_m <= distance_m) continue;
        sector.distance_m = distance_m;
        sector.at_m = at_m;
    }
}

SectorDistances::Sectors SectorDistances::at(double now_s, const PoseAt& poseAt) const {
    Look look(now_s, poseAt);
    if (now_s < latest_s_ - settings_.stale_s) return look.sectors;  // because the clock went back
    for (const auto& seen : seen_) {
        if (isFresh(*seen, now_s)) look.fresh_rad = std::min(look.fresh_rad, seen->from_rad);
    }
    for (auto each = seen_.rbegin(); each != seen_.rend(); ++each) {
        const Seen& seen = **each;
        if (!matters(seen, now_s)) continue;
        const bool is_fresh = isFresh(seen, now_s);
        // The sector is obsolete if a later turn has swept everything again. If that turn did not
        // see the horizon, no direction is free anyway, so doubts do not matter.
        const auto areAllPassed = [&](const std::array<double, kBins>& all_rad) {
            return seen.isPassed(*std::min_element(all_rad.begin(), all_rad.end()));
        };
        if (areAllPassed(look.passed_by_sensor_rad) && (!is_fresh || areAllPassed(look.passed_rad)))
            continue;
        const Frames frames = framesOf(seen, look);
        const auto since_s = seen.all_around_since_s;
        // Without turns, all observations of the period are at least as new as its start.
        const bool is_swept =
            seen.turns ? is_fresh : (since_s && now_s - *since_s <= settings_.stale_s);
        if (is_swept) {
            noteSensor(seen, frames, look);
            noteHorizon(seen, frames, look);
        }
        addObstacles(seen, frames, look);
    }
    for (int k = 0; k < kSectors; ++k) {
        Sector& sector = look.sectors[k];
        bool is_all = !look.is_doubtful[k];
        double oldest_s = sector.state == State::Obstacle ? sector.time_s : now_s;
        for (int bin = k * kParts; bin < (k + 1) * kParts; ++bin) {
            const bool is_passed = look.passed_rad[bin] > kNever;
            is_all = is_all && is_passed;
            if (is_passed) oldest_s = std::min(oldest_s, look.passed_s[bin]);
        }
        if (sector.state == State::Unknown && is_all) sector.state = State::SeenNothing;
        if (sector.state != State::Unknown) sector.time_s = oldest_s;
    }
    return look.sectors;
}

}  // namespace hagen::live
