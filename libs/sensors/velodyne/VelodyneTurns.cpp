#include "sensors/velodyne/VelodyneTurns.h"
#include <hagen/scan/SensorModel.h>
#include "sensors/captures/Remarks.h"

#include <cmath>
#include <iterator>

namespace hagen::sensors {
namespace {

constexpr std::size_t kMaxWaiting = 16, kOfSetClock = 16;
constexpr double kFollows = 2.5;  // max. gap, in packet periods
constexpr double kSecondUs = 1e6;
constexpr double kEndOfTurnUs = 50e3;          // max. gap within a turn
constexpr double kMaxTurnUs = 250e3;           // the slowest sensors turn at 5 Hz
constexpr std::size_t kMaxTurnPackets = 4000;  // exceeds the rate of every sensor
constexpr int kMinWrap = 100;                  // 0.01 degrees; smaller steps are jitter

}  // namespace

VelodyneTurns::VelodyneTurns(const VelodyneModel& model, std::string label,
                             const VelodyneCalibration* calibration, SilentSector silence)
    : model_(model),
      label_(std::move(label)),
      sensor_(std::make_shared<const SensorModel>(sensorModel(model.name))),
      calibration_(calibration != nullptr ? *calibration : defaultCalibration(model)),
      silence_(silence) {}

void VelodyneTurns::add(const VelodynePacket& packet) {
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
    if (ahead_us >= -period_us * kMaxWaiting && !follows_held) return insert(packet);
    held_.push_back(packet);
    if (held_.size() >= kOfSetClock) setClock();
}

/// Restarts at the held packets: several late packets in a row mean that the clock was set.
void VelodyneTurns::setClock() {
    flush();
    endTurn();
    has_last_ = false;
    ++counts_.interruptions;
    for (const VelodynePacket& packet : std::exchange(held_, {})) add(packet);
}

void VelodyneTurns::insert(const VelodynePacket& packet) {
    const double time_us = packet.sensorTimeUs();
    auto place = waiting_.end();
    while (place != waiting_.begin() && elapsedUs(std::prev(place)->sensorTimeUs(), time_us) < 0) {
        --place;
    }
    if (place != waiting_.begin() && std::prev(place)->bytes == packet.bytes) {
        ++counts_.duplicate;
        return;
    }
    counts_.late += place != waiting_.end();
    ++counts_.packets;
    counts_.dual += packet.isDual();
    waiting_.insert(place, packet);
    if (waiting_.size() <= kMaxWaiting) return;
    append(waiting_.front());
    waiting_.pop_front();
}

void VelodyneTurns::flush() {
    for (const VelodynePacket& packet : waiting_) append(packet);
    waiting_.clear();
}

void VelodyneTurns::finish() {
    while (!held_.empty()) setClock();  // each call removes packets from held_
    flush();
    endTurn();
}

/// Counts the packets missing before a packet, and ends the turn after a long gap.
void VelodyneTurns::checkGap(const VelodynePacket& packet) {
    if (!has_last_) return;
    const double gap_us = elapsedUs(last_us_, packet.sensorTimeUs());
    const double period_us = model_.packetPeriodUs(packet.isDual());
    const double silent = silence_.shareOf(last_azimuth_, packet.azimuth());
    const double sending_us = gap_us * (1 - silent);
    if (std::abs(sending_us) > kEndOfTurnUs) endTurn();
    if (std::abs(gap_us) > kSecondUs) {
        ++counts_.interruptions;
    } else if (sending_us > 1.5 * period_us) {
        counts_.lost += static_cast<std::size_t>(std::lround(sending_us / period_us)) - 1;
    }
}

void VelodyneTurns::append(const VelodynePacket& packet) {
    checkGap(packet);
    const double time_us = packet.sensorTimeUs();
    const int azimuth = packet.azimuth();
    const int turned = (azimuth - silence_.cut + kReadingsOfTurn) % kReadingsOfTurn;
    const bool wraps = azimuth >= 0 && turned < turned_ - kMinWrap;
    std::vector<std::uint8_t>& packets = turn_.packets;
    const bool is_long = std::abs(elapsedUs(turn_start_us_, time_us)) > kMaxTurnUs ||
                         packets.size() >= kMaxTurnPackets * kVelodynePacketBytes;
    if (wraps || is_long) endTurn();
    if (packets.empty()) {
        turn_.time_ns = packet.time_ns;
        turn_start_us_ = time_us;
    }
    packets.insert(packets.end(), packet.bytes.begin(), packet.bytes.end());
    has_last_ = true;
    last_us_ = time_us;
    if (azimuth < 0) return;
    last_azimuth_ = azimuth;
    turned_ = turned;
}

void VelodyneTurns::endTurn() {
    turned_ = -1;
    if (turn_.packets.empty()) return;
    ++counts_.scans;
    turn_.label = label_;
    turn_.sensor = sensor_;
    turn_.calibration = calibration_;
    complete_.push_back(std::exchange(turn_, {}));
}

std::string textOf(const VelodyneTurns::Counts& counts) {
    std::string text = counted(counts.packets, "packet") + " in " + counted(counts.scans, "turn");
    addCount(counts.dual, "packet", "with dual returns", text);
    addCount(counts.lost, "packet", "lost", text);
    addCount(counts.late, "packet", "reordered", text);
    addCount(counts.too_late, "packet", "more than 16 packets late, dropped", text);
    addCount(counts.duplicate, "duplicate packet", "dropped", text);
    addCount(counts.interruptions, "interruption", "(gap or clock jump)", text);
    return text;
}

}  // namespace hagen::sensors
