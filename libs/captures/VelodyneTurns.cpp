#include <hagen/captures/VelodyneTurns.h>

#include <hagen/range_image/SensorModel.h>

#include <algorithm>
#include <cmath>

#include <hagen/captures/Remarks.h>

namespace hagen::captures {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr int kBlockBytes = CObservationVelodyneScan::SIZE_BLOCK;
constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr std::size_t kMostWaiting = 16;
constexpr double kHourUs = 3600e6, kSecondUs = 1e6;
constexpr double kEndOfTurnUs = 50e3;       // without packets
constexpr double kLongestTurnUs = 250e3;    // the slowest sensors turn five times per second
constexpr std::size_t kMostPackets = 2000;  // more than any sensor sends in that time
constexpr int kLeastWrap = 100;             // 0.01 degrees; less is jitter of a sensor that stands

const std::uint8_t* bytesOf(const VelodynePacket& packet) {
    return reinterpret_cast<const std::uint8_t*>(&packet.raw);
}

/// From one time of the sensor's clock to another: within half an hour, since it wraps every hour.
double elapsedUs(double from_us, double to_us) { return std::remainder(to_us - from_us, kHourUs); }

bool isSame(const VelodynePacket& a, const VelodynePacket& b) {
    return std::equal(bytesOf(a), bytesOf(a) + sizeof a.raw, bytesOf(b));
}

}  // namespace

double VelodynePacket::sensorTimeUs() const {
    const std::uint8_t* const at = bytesOf(*this) + kBlocks * kBlockBytes;
    return static_cast<double>(at[0] | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 |
                               std::uint32_t{at[3]} << 24);
}

bool VelodynePacket::isDual() const {
    const std::uint8_t* const bytes = bytesOf(*this);
    return !isOfHdl64(bytes) &&
           bytes[kBlocks * kBlockBytes + 4] == CObservationVelodyneScan::RETMODE_DUAL;
}

int VelodynePacket::azimuth() const {
    for (int block = 0; block < kBlocks; ++block) {
        const std::uint8_t* const at = bytesOf(*this) + block * kBlockBytes;
        const int azimuth = at[2] | at[3] << 8;
        const bool is_block = (at[0] | at[1] << 8) == CObservationVelodyneScan::UPPER_BANK;
        if (is_block && azimuth < CObservationVelodyneScan::ROTATION_MAX_UNITS) return azimuth;
    }
    return -1;
}

VelodyneTurns::VelodyneTurns(const observations::VelodyneModel& model, std::string label,
                             std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration)
    : model_(model), label_(std::move(label)), calibration_(std::move(calibration)) {}

void VelodyneTurns::add(const VelodynePacket& packet) {
    const double time_us = packet.sensorTimeUs();
    const double latest_us = waiting_.empty() ? time_us : waiting_.back().sensorTimeUs();
    const double ahead_us = elapsedUs(latest_us, time_us);
    const double most_late_us = kMostWaiting * model_.packetPeriodUs(packet.isDual());
    if (ahead_us < -most_late_us) {  // too far back to be late: the clock was set
        flush();
        endTurn();
        has_last_ = false;
        ++counts_.interruptions;
    }
    auto place = waiting_.end();
    while (place != waiting_.begin() && elapsedUs(std::prev(place)->sensorTimeUs(), time_us) < 0) {
        --place;
    }
    if (place != waiting_.begin() && isSame(*std::prev(place), packet)) {
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
    for (const VelodynePacket& packet : waiting_) append(packet);
    waiting_.clear();
}

void VelodyneTurns::finish() {
    flush();
    endTurn();
}

/// Counts what is missing before a packet, and ends the turn if that is much.
void VelodyneTurns::checkGap(const VelodynePacket& packet) {
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

void VelodyneTurns::append(const VelodynePacket& packet) {
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
        turn_->calibration =
            calibration_ ? *calibration_ : observations::defaultCalibration(model_);
        const SensorModel sensor = sensorModel(model_.name);
        turn_->minRange = static_cast<double>(sensor.min_range_m);
        turn_->maxRange = static_cast<double>(sensor.max_range_m);
        turn_start_us_ = time_us;
    }
    turn_->scan_packets.push_back(packet.raw);
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
    addCount(counts.repeated, "packet", "repeated, left out", text);
    addCount(counts.interruptions, "interruption", "or jump of the sensor's clock", text);
    return text;
}

bool isVelodyneData(const std::uint8_t* bytes, std::size_t size) {
    if (size != CObservationVelodyneScan::PACKET_SIZE) return false;
    for (int block = 0; block < kBlocks; ++block) {
        const std::uint8_t* const at = bytes + block * kBlockBytes;
        const int header = at[0] | at[1] << 8;
        if (header == CObservationVelodyneScan::UPPER_BANK ||
            header == CObservationVelodyneScan::LOWER_BANK) {
            return true;
        }
    }
    return false;
}

bool isOfHdl64(const std::uint8_t* packet) {
    for (int block = 0; block < kBlocks; ++block) {
        const std::uint8_t* const at = packet + block * kBlockBytes;
        if ((at[0] | at[1] << 8) == CObservationVelodyneScan::LOWER_BANK) return true;
    }
    return false;
}

}  // namespace hagen::captures
