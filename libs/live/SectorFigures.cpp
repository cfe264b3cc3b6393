#include "live/SectorFigures.h"

#include <hagen/scan/Angle.h>
#include "base/NumberText.h"
#include "scan/AppendReturn.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hagen::live {
namespace {

constexpr double kDirections_s = 0.05;
constexpr double kTurn_s = 0.1;
constexpr std::size_t kTurnsChecked = 10;
constexpr double kMinTime_s = 0.125;  // minimum time for a rate
constexpr double kOtherRate = 0.2;    // minimum relative change that is reported
constexpr float kAirframe_m = 1;
constexpr double kAirframe_s = 10, kAirframeGap_s = 0.5;  // legs are not hit in every turn

SectorDistances::Settings settingsFor(const Eigen::Matrix3f& vehicle_from_sensor) {
    SectorDistances::Settings settings;
    settings.body_from_sensor.linear() = vehicle_from_sensor.cast<double>();
    return settings;
}

}  // namespace

SectorFigures::SectorFigures(const SensorModel& sensor, const Settings& settings,
                             LiveReport& report)
    : report_(report),
      sensor_(sensor),
      options_(settings.options),
      vehicle_from_sensor_(levelFromSensor(settings.mount)),
      distances_(sensor, settingsFor(vehicle_from_sensor_)) {
    report_.nearest_m.fill(std::numeric_limits<float>::infinity());
}

void SectorFigures::take(const LabelledSector& sector, double now_s) {
    const double latency_s = now_s - sector.last_time_s;
    if (sector.is_cut) {
        ++report_.sectors_cut;
    } else {
        report_.latency.add(latency_s);
        recent_.add(latency_s);
    }
    ++report_.sectors;
    report_.returns += sector.returns.size();
    report_.roi +=
        static_cast<std::size_t>(std::count(sector.label.begin(), sector.label.end(), Label::Roi));
    if (sector.sweep) {
        if (recent_sweep_rad_ == 0) recent_first_s_ = sector.first_time_s;
        recent_last_s_ = sector.last_time_s;
        recent_sweep_rad_ += sector.sweep->to_rad - sector.sweep->from_rad;
    }
    distances_.take(sector);
    report_.sectors_doubtful += sector.is_doubtful;
    noteNearest(sector);
}

void SectorFigures::checkTurn(const LabelledSector& sector) {
    if (turns_checked_ == kTurnsChecked || sector.is_doubtful) return;
    if (sector.first_time_s < turn_from_s_) return;
    if (turn_.size() == 0) turn_from_s_ = sector.first_time_s;
    for (std::size_t i = 0; i < sector.returns.size(); ++i) {
        appendReturn(sector.returns, i, turn_);
    }
    turn_labels_.insert(turn_labels_.end(), sector.label.begin(), sector.label.end());
    if (sector.last_time_s - turn_from_s_ < kTurn_s) return;
    check_.add(turn_, turn_labels_, sensor_, options_);
    ++turns_checked_;
    turn_from_s_ += 1;
    turn_.clear();
    turn_labels_.clear();
}

std::vector<std::string> SectorFigures::resultWarnings() const {
    return turns_checked_ < kTurnsChecked ? std::vector<std::string>() : check_.warnings();
}

void SectorFigures::noteNearest(const LabelledSector& sector) {
    if (sector.is_doubtful) return;
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        const Eigen::Vector3f at_m =
            vehicle_from_sensor_ * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        const int k = directionOf(at_m.head<2>(), SectorDistances::kSectors);
        report_.nearest_m[k] = std::min(report_.nearest_m[k], at_m.head<2>().norm());
        const float range_m = at_m.norm();
        if (range_m > kAirframe_m) continue;
        Near& near = near_[k];
        if (sector.last_time_s - near.last_s > kAirframeGap_s)
            near = {sector.last_time_s, 0, range_m};
        near.last_s = sector.last_time_s;
        near.nearest_m = std::min(near.nearest_m, range_m);
    }
}

std::string SectorFigures::airframeWarning(double now_s) const {
    std::size_t directions = 0;
    float nearest_m = kAirframe_m;
    bool is_due = false;
    for (const Near& near : near_) {
        const double stayed_s = near.last_s - near.since_s;
        if (now_s - near.last_s > kAirframeGap_s || stayed_s < kAirframe_s) continue;
        ++directions;
        nearest_m = std::min(nearest_m, near.nearest_m);
        // Waits for directions that were first seen a turn later.
        is_due = is_due || stayed_s >= kAirframe_s + kAirframeGap_s;
    }
    if (!is_due) return "";
    return "obstacles within 1 m of the sensor for 10 s in " +
           base::counted(directions, "direction") + " of 5 degrees, the nearest at " +
           base::fixedText(static_cast<double>(nearest_m), 2) +
           " m: if they are the vehicle's legs or arms, mask them with rawlog-segment "
           "--learn-airframe (docs/autopilot.md)";
}

void SectorFigures::countDirections(double now_s) {
    if (now_s - counted_s_ < kDirections_s) return;
    counted_s_ = now_s;
    for (const auto& direction : distances_.at(now_s)) {
        switch (direction.state) {
            case SectorDistances::State::Unknown:
                ++report_.times_unknown;
                break;
            case SectorDistances::State::SeenNothing:
                ++report_.times_seen_nothing;
                break;
            case SectorDistances::State::Obstacle:
                ++report_.times_obstacle;
                break;
        }
    }
}

LiveStatus SectorFigures::status(double passed_s, bool turns) const {
    LiveStatus status;
    status.turns_per_s = turns ? recent_sweep_rad_ / (2 * kPi) / passed_s
                               : static_cast<double>(recent_.count()) / passed_s;
    status.p50_s = recent_.quantile_s(0.5);
    status.p99_s = recent_.quantile_s(0.99);
    status.max_s = recent_.count() > 0 ? recent_.max_s() : std::nan("");
    for (const auto& sector : report_.latest) {
        if (sector.state != SectorDistances::State::Obstacle) continue;
        if (sector.distance_m >= status.nearest_m) continue;
        status.nearest_m = sector.distance_m;
        status.nearest_deg = degrees(std::atan2(-sector.at_m.y(), sector.at_m.x()));
    }
    return status;
}

std::optional<RateChange> SectorFigures::rateChange() {
    const double arrived_s = recent_last_s_ - recent_first_s_;  // shorter at the start of a session
    if (arrived_s <= kMinTime_s || recent_sweep_rad_ <= 0) return std::nullopt;
    const double rate = recent_sweep_rad_ / (2 * kPi) / arrived_s;
    const bool is_odd = reported_rate_ > 0 && std::abs(rate / reported_rate_ - 1) > kOtherRate;
    odd_rates_ = is_odd ? odd_rates_ + 1 : 0;
    if (reported_rate_ > 0 && odd_rates_ < 2) return std::nullopt;
    const RateChange change{reported_rate_, rate};
    reported_rate_ = rate;
    odd_rates_ = 0;
    if (change.before == 0) return std::nullopt;
    ++report_.rate_changes;
    return change;
}

void SectorFigures::next() {
    recent_ = {};
    recent_sweep_rad_ = 0;
}

}  // namespace hagen::live
