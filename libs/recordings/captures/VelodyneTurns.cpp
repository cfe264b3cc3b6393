#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/Remarks.h>
#include <hagen/recordings/VelodyneTurns.h>
#include <hagen/scan/SensorModel.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr std::size_t kMostWaiting = 16, kOfSetClock = 16;
constexpr double kFollows = 2.5;  // periods
constexpr double kHourUs = 3600e6, kSecondUs = 1e6;
constexpr double kEndOfTurnUs = 50e3;       // without packets
constexpr double kLongestTurnUs = 250e3;    // the slowest sensors turn five times per second
constexpr std::size_t kMostPackets = 2000;  // more than any sensor sends in that time
constexpr int kLeastWrap = 100;             // 0.01 degrees; less is jitter of a sensor that stands

/// From one time of the sensor's clock to another: within half an hour, since it wraps every hour.
double elapsedUs(double from_us, double to_us) { return std::remainder(to_us - from_us, kHourUs); }

}  // namespace

VelodyneTurns::VelodyneTurns(const sensors::VelodyneModel& model, std::string label,
                             const sensors::VelodyneCalibration* calibration)
    : model_(model),
      label_(std::move(label)),
      calibration_(observations::mrptCalibration(
          calibration != nullptr ? *calibration : sensors::defaultCalibration(model))) {}

void VelodyneTurns::add(const sensors::VelodynePacket& packet) {
    const double time_us = packet.sensorTimeUs();
    const double latest_us = waiting_.empty() ? time_us : waiting_.back().sensorTimeUs();
    const double ahead_us = elapsedUs(latest_us, time_us);
    const double period_us = model_.packetPeriodUs(packet.isDual());
    if (ahead_us >= 0) {
        counts_.too_late += held_.size();
        held_.clear();
        return insert(packet);
    }
    const double after_held_us =
        held_.empty() ? -1 : elapsedUs(held_.back().sensorTimeUs(), time_us);
    const bool follows_held = after_held_us >= 0 && after_held_us <= kFollows * period_us;
    if (ahead_us >= -period_us * kMostWaiting && !follows_held) return insert(packet);
    held_.push_back(packet);
    if (held_.size() >= kOfSetClock) setClock();
}

/// So far back, one packet waited in a network, or is a copy. Several in a row are of a clock that
/// was set.
void VelodyneTurns::setClock() {
    flush();
    endTurn();
    has_last_ = false;
    ++counts_.interruptions;
    for (const sensors::VelodynePacket& packet : std::exchange(held_, {})) add(packet);
}

void VelodyneTurns::insert(const sensors::VelodynePacket& packet) {
    const double time_us = packet.sensorTimeUs();
    auto place = waiting_.end();
    while (place != waiting_.begin() && elapsedUs(std::prev(place)->sensorTimeUs(), time_us) < 0) {
        --place;
    }
    if (place != waiting_.begin() && std::prev(place)->bytes == packet.bytes) {
        ++counts_.repeated;
        return;
    }
    counts_.out_of_order += place != waiting_.end();
    ++counts_.packets;
    counts_.dual += packet.isDual();
    waiting_.insert(place, packet);
    if (waiting_.size() <= kMostWaiting) return;
    append(waiting_.front());
    waiting_.pop_front();
}

void VelodyneTurns::flush() {
    for (const sensors::VelodynePacket& packet : waiting_) append(packet);
    waiting_.clear();
}

void VelodyneTurns::finish() {
    while (!held_.empty()) setClock();  // each leaves fewer
    flush();
    endTurn();
}

/// Counts what is missing before a packet, and ends the turn if that is much.
void VelodyneTurns::checkGap(const sensors::VelodynePacket& packet) {
    if (!has_last_) return;
    const double gap_us = elapsedUs(last_us_, packet.sensorTimeUs());
    const double period_us = model_.packetPeriodUs(packet.isDual());
    if (std::abs(gap_us) > kEndOfTurnUs) endTurn();
    if (std::abs(gap_us) > kSecondUs) {
        ++counts_.interruptions;
    } else if (gap_us > 1.5 * period_us) {
        counts_.lost += static_cast<std::size_t>(std::lround(gap_us / period_us)) - 1;
    }
}

void VelodyneTurns::append(const sensors::VelodynePacket& packet) {
    checkGap(packet);
    const double time_us = packet.sensorTimeUs();
    const int azimuth = packet.azimuth();
    const bool wraps = azimuth >= 0 && azimuth < last_azimuth_ - kLeastWrap;
    const bool is_long = turn_ && (std::abs(elapsedUs(turn_start_us_, time_us)) > kLongestTurnUs ||
                                   turn_->scan_packets.size() >= kMostPackets);
    if (turn_ && (wraps || is_long)) endTurn();
    if (!turn_) {
        turn_ = CObservationVelodyneScan::Create();
        turn_->timestamp = timeOf(packet.time_ns);
        turn_->originalReceivedTimestamp = turn_->timestamp;
        turn_->sensorLabel = label_;
        turn_->calibration = calibration_;
        const SensorModel sensor = sensorModel(model_.name);
        turn_->minRange = static_cast<double>(sensor.min_range_m);
        turn_->maxRange = static_cast<double>(sensor.max_range_m);
        turn_start_us_ = time_us;
    }
    auto& raw = turn_->scan_packets.emplace_back();
    static_assert(sizeof raw == sizeof packet.bytes);
    std::memcpy(static_cast<void*>(&raw), packet.bytes.data(), sizeof raw);
    has_last_ = true;
    last_us_ = time_us;
    if (azimuth >= 0) last_azimuth_ = azimuth;
}

void VelodyneTurns::endTurn() {
    last_azimuth_ = -1;
    if (!turn_) return;
    ++counts_.turns;
    complete_.push_back(std::move(turn_));
    turn_.reset();
}

std::string textOf(const VelodyneTurns::Counts& counts) {
    std::string text = counted(counts.packets, "packet") + " in " + counted(counts.turns, "turn");
    addCount(counts.dual, "packet", "with dual returns", text);
    addCount(counts.lost, "packet", "lost", text);
    addCount(counts.out_of_order, "packet", "out of order, put back", text);
    addCount(counts.too_late, "packet", "more than sixteen packets late, left out", text);
    addCount(counts.repeated, "packet", "repeated, left out", text);
    addCount(counts.interruptions, "interruption", "or jump of the sensor's clock", text);
    return text;
}

}  // namespace hagen::recordings
