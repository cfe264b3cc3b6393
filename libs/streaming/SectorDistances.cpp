#include <hagen/range_image/Angle.h>
#include <hagen/streaming/SectorDistances.h>

#include <algorithm>
#include <cmath>

namespace hagen::streaming {
namespace {

constexpr double kTurn_rad = 2 * kPi;
// Packets begin and end between the firings, and beams have a width.
constexpr double kTolerance_rad = 0.005;
constexpr double kPeriod_s = 0.1;  // of a sensor without turns

/// The same direction, from 0 up to a turn.
double withinTurn(double angle_rad) {
    const double turned_rad = angle_rad - kTurn_rad * std::floor(angle_rad / kTurn_rad);
    return turned_rad < kTurn_rad ? turned_rad : 0;  // rounded up
}

/// What a packet swept, in any turn.
class Swept {
 public:
    explicit Swept(const Sweep& sweep)
        : from_rad_(withinTurn(sweep.from_rad - kTolerance_rad)),
          width_rad_(sweep.to_rad - sweep.from_rad + kTolerance_rad) {}

    /// `direction_rad` from 0 up to a turn; false for NaN. The gap before a packet counts as swept:
    /// the sensor has passed it. Those up to a tolerance behind it have not been passed.
    bool has(double direction_rad, double tolerance_rad) const {
        const double into_rad = direction_rad - from_rad_;
        return (into_rad < 0 ? into_rad + kTurn_rad : into_rad) <= width_rad_ + tolerance_rad;
    }

 private:
    double from_rad_, width_rad_;
};

}  // namespace

SectorDistances::SectorDistances(const SensorModel& sensor, const Settings& settings)
    : settings_(settings) {
    const double lowest_rad = static_cast<double>(sensor.elevations_rad.front());
    const double highest_rad = static_cast<double>(sensor.elevations_rad.back());
    const Eigen::Matrix3d sensor_from_body =
        settings.body_from_sensor.linear().cast<double>().transpose();
    for (int bin = 0; bin < kBins; ++bin) {
        const double clockwise_rad = bin * kTurn_rad / kBins;
        const Eigen::Vector3d ahead =
            sensor_from_body *
            Eigen::Vector3d(std::cos(clockwise_rad), -std::sin(clockwise_rad), 0);
        const double elevation_rad = std::asin(std::clamp(ahead.z(), -1.0, 1.0));
        const bool is_seen = elevation_rad >= lowest_rad && elevation_rad <= highest_rad;
        sensor_rad_[bin] = is_seen ? withinTurn(-std::atan2(ahead.y(), ahead.x())) : std::nan("");
    }
}

/// Without turns: what was seen in the period before the last one is forgotten.
void SectorDistances::beginFrame(double time_s) {
    const double since_s = time_s - period_start_s_;
    if (since_s >= 0 && since_s < kPeriod_s) return;
    period_start_s_ = time_s;
    const bool is_next = since_s >= 0 && since_s < 2 * kPeriod_s;
    for (Bin& bin : bins_) bin = {{}, is_next ? bin.latest : Found()};
}

/// What a lost packet would have seen is not known.
void SectorDistances::noteSwept(const LabelledSector& sector) {
    if (!sector.sweep) {
        if (!frames_.add(sector.first_time_s, sector.measured_s)) return;
        for (int e = 0; e < kBins; ++e) {
            if (!std::isnan(sensor_rad_[e])) edges_[e].swept_s = sector.first_time_s;
        }
        return;
    }
    const auto noteSweep = [&](const Sweep& sweep) {
        const Swept swept(sweep);
        for (int e = 0; e < kBins; ++e) {
            if (!swept.has(sensor_rad_[e], kTolerance_rad)) continue;
            edges_[e].swept_s = sector.first_time_s;
            if (!swept.has(sensor_rad_[e], 0)) continue;
            edges_[e].passed_s = sector.first_time_s;
            edges_[e].passed_rad = sector.sweep->to_rad;
        }
    };
    if (sector.packets == nullptr) {
        noteSweep(*sector.sweep);
    } else {
        for (const Sweep& packet : *sector.packets) noteSweep(packet);
    }
}

void SectorDistances::take(const LabelledSector& sector) {
    const double now_rad = sector.sweep ? sector.sweep->to_rad : 0;
    if (sector.first_time_s < latest_s_) {
        bins_.fill({});
        edges_.fill({});
    }
    latest_s_ = sector.first_time_s;
    if (!sector.sweep) beginFrame(sector.first_time_s);
    noteSwept(sector);
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        const Eigen::Vector3f at =
            settings_.body_from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        if (at.z() < settings_.low_m || at.z() > settings_.high_m) continue;
        const double clockwise_rad = -static_cast<double>(std::atan2(at.y(), at.x()));
        const double turned_rad = clockwise_rad < 0 ? clockwise_rad + kTurn_rad : clockwise_rad;
        Bin& bin = bins_[std::min(static_cast<int>(turned_rad / kTurn_rad * kBins), kBins - 1)];
        // The sectors on both sides of a bin's middle are of the same turn.
        if (std::abs(now_rad - bin.latest.turned_rad) > kPi) bin = {{}, bin.latest};
        const float distance_m = at.head<2>().norm();
        bin.latest = {sector.first_time_s, now_rad, std::min(bin.latest.distance_m, distance_m)};
    }
}

/// An obstacle is gone once a later turn has passed all of its bin.
bool SectorDistances::isGone(const Found& found, int bin) const {
    const Edge &begin = edges_[bin], &end = edges_[(bin + 1) % kBins];
    const Edge& first = begin.passed_rad < end.passed_rad ? begin : end;
    return std::abs(first.passed_rad - found.turned_rad) > kPi && first.passed_s > found.time_s;
}

std::array<SectorDistances::Sector, SectorDistances::kSectors> SectorDistances::at(
    double now_s) const {
    std::array<Sector, kSectors> sectors;
    const auto isFresh = [&](double time_s) {
        const double age_s = now_s - time_s;
        return age_s >= 0 && age_s <= settings_.stale_s;
    };
    for (int k = 0; k < kSectors; ++k) {
        Sector& sector = sectors[k];
        double oldest_s = now_s, nearest_m = std::numeric_limits<double>::infinity();
        for (int bin = k * kParts; bin < (k + 1) * kParts; ++bin) {
            for (const Found* const found : {&bins_[bin].latest, &bins_[bin].earlier}) {
                const bool is_there = isFresh(found->time_s) && !isGone(*found, bin);
                if (!is_there || !std::isfinite(found->distance_m)) continue;
                nearest_m = std::min(nearest_m, static_cast<double>(found->distance_m));
                oldest_s = std::min(oldest_s, found->time_s);
            }
        }
        bool is_swept = true;
        for (int e = k * kParts; e <= (k + 1) * kParts; ++e) {
            const double swept_s = edges_[e % kBins].swept_s;
            is_swept = is_swept && isFresh(swept_s);
            if (isFresh(swept_s)) oldest_s = std::min(oldest_s, swept_s);
        }
        if (std::isfinite(nearest_m)) {
            sector = {State::Obstacle, static_cast<float>(nearest_m), oldest_s};
        } else if (is_swept) {
            sector.state = State::SeenNothing;
            sector.time_s = oldest_s;
        }
    }
    return sectors;
}

}  // namespace hagen::streaming
