#include "LiveReporter.h"

#include <hagen/range_image/Angle.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace hagen::live {
namespace {

using streaming::SectorDistances;

constexpr double kStatus_s = 0.5;
constexpr double kDirections_s = 0.05;
constexpr double kOtherRate = 0.2;  // of the turns, is told

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace

LiveReporter::LiveReporter(const LiveOptions& options, const LiveListener& listener,
                           const LiveSensor& sensor)
    : options_(options),
      listener_(listener),
      sensor_(sensor),
      distances_(sensor.segmenter().sensor()),
      start_s_(steadyNow_s()),
      status_s_(start_s_) {
    report_.nearest_m.fill(std::numeric_limits<float>::infinity());
}

void LiveReporter::sector(const streaming::LabelledSector& sector) {
    const double latency_s = steadyNow_s() - sector.last_time_s;
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
    listener_.sector(sector);
}

void LiveReporter::noteNearest(const streaming::LabelledSector& sector) {
    if (sector.is_doubtful) return;
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        const double clockwise_rad = -static_cast<double>(scan.azimuth_rad[i]);
        const double share = clockwise_rad / (2 * kPi) + (clockwise_rad < 0 ? 1 : 0);
        const int k = std::min(static_cast<int>(share * SectorDistances::kSectors),
                               SectorDistances::kSectors - 1);
        report_.nearest_m[k] = std::min(report_.nearest_m[k], std::hypot(scan.x_m[i], scan.y_m[i]));
    }
}

void LiveReporter::packet() {
    if (is_silent_) {
        is_silent_ = false;
        listener_.remark("packets come again");
    }
    if (sensor_.modeChanges() == report_.mode_changes) return;
    report_.mode_changes = sensor_.modeChanges();
    listener_.remark(sensor_.isDual() ? "the sensor sends two returns per firing now"
                                      : "the sensor sends one return per firing now");
}

LiveReport& LiveReporter::report() {
    sensor_.count(report_);
    const double now_s = steadyNow_s();
    report_.latest = distances_.at(now_s);
    report_.seconds = now_s - start_s_;
    return report_;
}

/// Another speed of the motor, twice in a row: packets may have come in a burst.
void LiveReporter::tellRate() {
    const double arrived_s = recent_last_s_ - recent_first_s_;  // not all of the time, at first
    const double rate = arrived_s > kStatus_s / 4 ? recent_sweep_rad_ / (2 * kPi) / arrived_s : 0;
    if (!sensor_.hasTurns() || rate <= 0 || is_silent_) return;
    const bool is_odd = rate_told_ > 0 && std::abs(rate / rate_told_ - 1) > kOtherRate;
    odd_rates_ = is_odd ? odd_rates_ + 1 : 0;
    if (odd_rates_ == 2) {
        ++report_.rate_changes;
        listener_.remark("the sensor turns " + fixed(rate, 1) + " times per second now, " +
                         fixed(rate_told_, 1) + " before");
    }
    if (rate_told_ == 0 || odd_rates_ == 2) {
        rate_told_ = rate;
        odd_rates_ = 0;
    }
}

void LiveReporter::showStatus(double now_s) {
    report();
    LiveStatus status;
    const double passed_s = now_s - status_s_;
    status.turns_per_s = recent_sweep_rad_ / (2 * kPi) / passed_s;
    if (!sensor_.hasTurns()) status.turns_per_s = static_cast<double>(recent_.count()) / passed_s;
    status.p50_s = recent_.quantile_s(0.5);
    status.p99_s = recent_.quantile_s(0.99);
    status.max_s = recent_.count() > 0 ? recent_.max_s() : std::nan("");
    status.is_silent = is_silent_;
    for (const auto& sector : report_.latest) {
        if (sector.state != SectorDistances::State::Obstacle) continue;
        if (!(sector.distance_m >= status.nearest_m)) status.nearest_m = sector.distance_m;
    }
    tellRate();
    recent_ = {};
    recent_sweep_rad_ = 0;
    status_s_ = now_s;
    listener_.status(report_, status);
}

void LiveReporter::countDirections(double now_s) {
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

void LiveReporter::look(double now_s) {
    const double last_packet_s = sensor_.lastPacket_s();
    const double silent_s = now_s - (last_packet_s > 0 ? last_packet_s : start_s_);
    if (!is_silent_ && silent_s > kSilence_s) {
        is_silent_ = true;
        ++report_.silences;
        report();
        listener_.remark(report_.packets > 0
                             ? "no packets of the sensor for " + fixed(kSilence_s, 0) + " s"
                             : "no packet of " + nameOf(options_) + " has come yet");
    }
    if (!is_recording_told_) {
        const std::string failure = sensor_.recordingFailure();
        if (!failure.empty()) {
            is_recording_told_ = true;
            listener_.remark("recording has ended: " + failure);
        }
    }
    countDirections(now_s);
    if (now_s - status_s_ >= kStatus_s) showStatus(now_s);
}

}  // namespace hagen::live
