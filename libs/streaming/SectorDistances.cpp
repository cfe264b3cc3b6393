#include <hagen/range_image/Angle.h>
#include <hagen/streaming/SectorDistances.h>

#include <algorithm>
#include <cmath>

namespace hagen::streaming {
namespace {

constexpr double kTurn_rad = 2 * kPi;
constexpr int kTurn_deg = 360;

/// Of a direction, clockwise from ahead.
int degreeOf(float x_m, float y_m) {
    const double clockwise_rad = -static_cast<double>(std::atan2(y_m, x_m));
    const double turned_rad = clockwise_rad < 0 ? clockwise_rad + kTurn_rad : clockwise_rad;
    return std::min(static_cast<int>(turned_rad / kTurn_rad * kTurn_deg), kTurn_deg - 1);
}

int wrapped(int degree) { return (degree % kTurn_deg + kTurn_deg) % kTurn_deg; }

}  // namespace

SectorDistances::SectorDistances(const SensorModel& sensor, const Settings& settings)
    : settings_(settings) {
    const double lowest_rad = static_cast<double>(sensor.elevations_rad.front());
    const double highest_rad = static_cast<double>(sensor.elevations_rad.back());
    const Eigen::Matrix3d sensor_from_body =
        settings.body_from_sensor.linear().cast<double>().transpose();
    const auto azimuthOfEdge = [&](int edge) {
        const double clockwise_rad = edge * kTurn_rad / kBins;
        const Eigen::Vector3d ahead =
            sensor_from_body *
            Eigen::Vector3d(std::cos(clockwise_rad), -std::sin(clockwise_rad), 0);
        const double elevation_rad = std::asin(std::clamp(ahead.z(), -1.0, 1.0));
        const bool is_seen = elevation_rad >= lowest_rad && elevation_rad <= highest_rad;
        return is_seen ? -std::atan2(ahead.y(), ahead.x()) : std::nan("");
    };
    for (int k = 0; k < kBins; ++k) {
        arcs_[k] = TurnCoverage::between(azimuthOfEdge(k), azimuthOfEdge(k + 1));
    }
}

/// What a lost packet would have seen is not known: a degree was swept if all of it was, without a
/// gap.
void SectorDistances::noteSwept(const LabelledSector& sector) {
    const double now_s = sector.first_time_s;
    if (!sector.sweep) {
        const std::optional<double> since_s =
            frames_.add(now_s, sector.measured_s, sector.sensor_time_s);
        if (!since_s) return;
        all_around_since_s_ = *since_s;
        for (int k = 0; k < kBins; ++k) {
            if (!std::isnan(arcs_[k].begin_rad)) bins_[k].swept_s = *since_s;
        }
        return;
    }
    const std::vector<TurnCoverage::Swept>& packets = coverage_.add(sector);
    if (packets.empty()) return;
    TurnCoverage::Swept all = packets.front();  // most degrees are elsewhere
    for (const TurnCoverage::Swept& swept : packets) {
        all.looked_from_rad =
            std::min({all.looked_from_rad, swept.looked_from_rad, swept.from_rad});
        all.looked_to_rad = std::max({all.looked_to_rad, swept.looked_to_rad, swept.to_rad});
    }
    for (int k = 0; k < kBins; ++k) {
        if (!beginOfArc(all, arcs_[k])) continue;
        for (const TurnCoverage::Swept& swept : packets) {
            noteSwept(swept, arcs_[k], now_s, bins_[k]);
        }
    }
    for (int degree = 0; degree < kBins; ++degree) {
        const TurnCoverage::Arc arc{degree * kTurn_rad / kBins, kTurn_rad / kBins};
        if (!beginOfArc(all, arc)) continue;
        for (const TurnCoverage::Swept& swept : packets) {
            const auto end_rad = endOfArc(swept, arc);
            if (!end_rad || *end_rad < passed_[degree].end_rad + kPi) continue;
            passed_[degree] = {*end_rad, now_s};
        }
    }
}

void SectorDistances::noteSwept(const TurnCoverage::Swept& swept, const TurnCoverage::Arc& arc,
                                double now_s, Bin& bin) {
    const auto begun_rad = beginOfArc(swept, arc);
    if (begun_rad && *begun_rad > bin.begun_rad + kPi) {
        bin.begun_rad = *begun_rad;
        bin.begun_s = now_s;
    }
    const auto end_rad = endOfArc(swept, arc);
    if (!end_rad || *end_rad < bin.end_rad + kPi) return;
    bin.end_rad = *end_rad;
    bin.swept_s = bin.begun_s;
}

void SectorDistances::take(const LabelledSector& sector) {
    if (sector.first_time_s < latest_s_) {
        bins_.fill({});
        passed_.fill({});
        coverage_.clear();
        all_around_since_s_ = kNever;
    }
    latest_s_ = sector.first_time_s;
    noteSwept(sector);
    if (!sector.sweep) frames_rad_ += kTurn_rad;  // each frame counts as a turn
    const double now_rad = sector.sweep ? coverage_.head_rad() : frames_rad_;
    const bool is_body = settings_.body_from_sensor.matrix().isIdentity(0);
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        const Eigen::Vector3f at =
            settings_.body_from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        if (at.z() < settings_.low_m || at.z() > settings_.high_m) continue;
        const int k = degreeOf(at.x(), at.y());
        const int degree = is_body ? k : degreeOf(scan.x_m[i], scan.y_m[i]);
        Bin& bin = bins_[k];
        // The sectors on both sides of a bin's middle are of the same turn.
        if (bin.found.empty() || now_rad - bin.found.back().turned_rad > kPi) {
            forgetFound(sector.first_time_s, bin);
            bin.found.emplace_back();
            bin.found.back().first_degree = bin.found.back().last_degree = degree;
        }
        Found& found = bin.found.back();
        found.time_s = sector.first_time_s;
        found.turned_rad = now_rad;
        found.distance_m = std::min(found.distance_m, at.head<2>().norm());
        if (wrapped(degree - found.first_degree) <= found.last_degree - found.first_degree)
            continue;
        const int after = wrapped(degree - found.last_degree);
        const int before = wrapped(found.first_degree - degree);
        if (after <= before) {
            found.last_degree += after;
        } else {
            found.first_degree -= before;
        }
    }
}

void SectorDistances::forgetFound(double now_s, Bin& bin) const {
    // A period that ends this one's doubt may still be fresh (at()).
    const double oldest_s = now_s - settings_.stale_s - FrameCoverage::kForgotten_s;
    const auto isOver = [&](const Found& found) {
        return isGone(found) || !(found.time_s >= oldest_s && found.time_s <= now_s);
    };
    bin.found.erase(std::remove_if(bin.found.begin(), bin.found.end(), isOver), bin.found.end());
}

/// An obstacle is gone once a later turn has passed all degrees in which the sensor saw it, or a
/// sensor without turns has looked all around since. A sensor that is tilted, or beside the body,
/// looks at the horizon of the obstacle's bin at another time.
bool SectorDistances::isGone(const Found& found) const {
    if (all_around_since_s_ - found.time_s > FrameCoverage::kForgotten_s) return true;
    for (int degree = found.first_degree; degree <= found.last_degree; ++degree) {
        const Passed& passed = passed_[wrapped(degree)];
        if (!(passed.time_s > found.time_s)) return false;
        if (!(passed.end_rad - found.turned_rad > kLaterTurn_rad)) return false;
    }
    return true;
}

bool SectorDistances::isFresh(double time_s, double now_s) const {
    const double age_s = now_s - time_s;
    return age_s >= 0 && age_s <= settings_.stale_s;
}

std::array<SectorDistances::Sector, SectorDistances::kSectors> SectorDistances::at(
    double now_s) const {
    std::array<Sector, kSectors> sectors;
    for (int k = 0; k < kSectors; ++k) {
        Sector& sector = sectors[k];
        double oldest_s = now_s, nearest_m = std::numeric_limits<double>::infinity();
        bool is_swept = true;
        for (int part = k * kParts; part < (k + 1) * kParts; ++part) {
            const Bin& bin = bins_[part];
            for (const Found& found : bin.found) {
                if (isGone(found) || !std::isfinite(found.distance_m)) continue;
                if (!isFresh(found.time_s, now_s)) {
                    is_swept = false;  // growing old makes no obstacle free
                    continue;
                }
                nearest_m = std::min(nearest_m, static_cast<double>(found.distance_m));
                oldest_s = std::min(oldest_s, found.time_s);
            }
            const bool is_fresh = isFresh(bin.swept_s, now_s);
            is_swept = is_swept && is_fresh;
            if (is_fresh) oldest_s = std::min(oldest_s, bin.swept_s);
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
