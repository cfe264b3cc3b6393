#include <hagen/range_image/Airframe.h>
#include <hagen/range_image/Angle.h>
#include <hagen/streaming/VelodyneStream.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "CheckTime.h"

namespace hagen::streaming {
namespace {

using packets::VelodynePacket;

constexpr std::size_t kMostLate = 16;
constexpr double kHourUs = 3600e6, kInterruptionUs = 50e3;
constexpr double kTurn_rad = 2 * kPi;
constexpr double kOverlap_rad = 0.2;  // of packets that are not full
constexpr int kBlocks = packets::kVelodyneBlocks;
constexpr int kReadings = packets::kReadingsOfTurn;

/// From one time of the sensor's clock to another: within half an hour, since it wraps every hour.
double elapsedUs(double from_us, double to_us) { return std::remainder(to_us - from_us, kHourUs); }

}  // namespace

VelodyneStream::VelodyneStream(const packets::VelodyneModel& model, const Settings& settings,
                               StreamingSegmenter::Take take, const StreamingOptions& streaming,
                               const packets::VelodyneCalibration* calibration)
    : model_(model),
      settings_(settings),
      calibration_(calibration != nullptr ? *calibration : packets::defaultCalibration(model)) {
    const bool is_hdl64 = &model == &packets::hdl64Model();
    if (is_hdl64 && calibration == nullptr) {
        throw std::invalid_argument("packets of an HDL-64E need its calibration");
    }
    SensorModel sensor = packets::sensorOf(calibration_, model.name);
    const SensorModel limits = sensorModel(model.name);
    sensor.min_range_m = settings.sensor.min_range_m.value_or(limits.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(limits.max_range_m);
    filterFor(sensor, settings.options);  // throws SettingsError
    segmenter_ = std::make_unique<StreamingSegmenter>(std::move(sensor), settings.options,
                                                      std::move(take), streaming);
    segmenter_->setMount(settings_.tiltOnLevelVehicle());
}

void VelodyneStream::setAttitude(const std::optional<Attitude>& attitude) {
    segmenter_->setAttitude(attitude);
}

void VelodyneStream::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    segmenter_->setPose(map_from_sensor);
}

bool VelodyneStream::isRepeated(const VelodynePacket& packet, double time_us) const {
    return std::any_of(recent_.begin(), recent_.end(), [&](const VelodynePacket& other) {
        return other.sensorTimeUs() == time_us && other.bytes == packet.bytes;
    });
}

/// What a packet swept; the packets since the one before may be lost. Returns false if it has no
/// sound block.
bool VelodyneStream::readSweep(const VelodynePacket& packet, double elapsed_us,
                               Sweep& sweep) const {
    const bool is_hdl64 = &model_ == &packets::hdl64Model();
    const int blocks_per_firing = packet.isDual() || is_hdl64 ? 2 : 1;
    int first = -1, last = -1;
    for (int b = 0; b < kBlocks; ++b) {
        if (packet.azimuthOf(b) < 0) continue;
        if (first < 0) first = b;
        last = b;
    }
    if (first < 0) return false;
    const int firings = last / blocks_per_firing - first / blocks_per_firing;
    int turned = packet.azimuthOf(last) - packet.azimuthOf(first);
    if (turned < 0) turned += kReadings;
    // A packet sweeps a few degrees; more is a broken reading.
    const int all_firings = kBlocks / blocks_per_firing;
    const double per_firing = turned * all_firings < firings * kReadings / 8
                                  ? static_cast<double>(turned) / firings
                                  : 0.0;
    const int before = first / blocks_per_firing;
    const double from = packet.azimuthOf(first) - per_firing * before;
    const double swept_rad = radians(0.01 * per_firing * all_firings);
    sweep.from_rad = radians(0.01 * from);
    if (has_last_) {
        // Whole turns that are missing do not count: what was seen before is not overwritten.
        const double period_us = model_.packetPeriodUs(packet.isDual());
        double turned_rad = std::remainder(elapsed_us / period_us * swept_rad, kTurn_rad);
        if (elapsed_us > 0 && turned_rad < -kOverlap_rad) turned_rad += kTurn_rad;
        const double expected_rad = last_sweep_.from_rad + turned_rad;
        sweep.from_rad = expected_rad + std::remainder(sweep.from_rad - expected_rad, kTurn_rad);
    }
    sweep.to_rad = sweep.from_rad + swept_rad;
    return true;
}

VelodyneStream::Taken VelodyneStream::add(const std::uint8_t* bytes, std::size_t size,
                                          double arrival_s) {
    checkTime(arrival_s);
    if (!packets::isVelodyneData(bytes, size)) {
        ++counts_.wrong_size;
        return Taken::WrongSize;
    }
    const bool is_hdl64 = &model_ == &packets::hdl64Model();
    if (packets::isOfHdl64(bytes) != is_hdl64 ||
        (!is_hdl64 && bytes[packets::kVelodyneModelAt] != model_.id)) {
        ++counts_.other_model;
        return Taken::OtherModel;
    }
    VelodynePacket packet;
    std::copy_n(bytes, size, packet.bytes.begin());
    const double time_us = packet.sensorTimeUs();
    if (isRepeated(packet, time_us)) {
        ++counts_.repeated;
        return Taken::Repeated;
    }
    const bool is_dual = packet.isDual();
    // From the packet before to this one: as long as the one before lasted.
    const double period_us = model_.packetPeriodUs(has_last_ ? is_dual_ : is_dual);
    double elapsed_us = has_last_ ? elapsedUs(last_us_, time_us) : 0;
    if (has_last_ && (elapsed_us < -static_cast<double>(kMostLate) * period_us ||
                      elapsed_us > kInterruptionUs)) {
        ++counts_.interruptions;
        const bool is_jump = elapsed_us < 0 || elapsed_us > 1e6 * segmenter_->streaming().context_s;
        if (elapsed_us > 0 && elapsed_us < 1e6) {
            counts_.lost += static_cast<std::size_t>(std::lround(elapsed_us / period_us)) - 1;
        }
        segmenter_->flush();
        if (is_jump) {
            segmenter_->restart();
            has_last_ = false;
        }
    }
    Sweep sweep{};
    if (!readSweep(packet, elapsed_us, sweep)) {
        ++counts_.unsound;
        return Taken::Unsound;
    }
    recent_.push_back(packet);
    if (recent_.size() > kMostLate) recent_.pop_front();
    if (has_last_ && is_dual != is_dual_) ++counts_.mode_changes;
    is_dual_ = is_dual;
    const bool is_late = has_last_ && elapsed_us < 0;
    if (is_late) {
        ++counts_.late;
        if (counts_.lost > 0) --counts_.lost;
    } else {
        if (has_last_ && elapsed_us > 1.5 * period_us && elapsed_us <= kInterruptionUs) {
            counts_.lost += static_cast<std::size_t>(std::lround(elapsed_us / period_us)) - 1;
        }
        if (has_last_) {
            counts_.turns += static_cast<std::size_t>(
                std::max(0.0, std::floor(sweep.from_rad / kTurn_rad) -
                                  std::floor(last_sweep_.from_rad / kTurn_rad)));
        }
        last_us_ = time_us;
        last_sweep_ = sweep;
        has_last_ = true;
    }
    counts_.unsound_blocks +=
        decodePackets({packet.bytes.data(), 1}, calibration_, returns_, decoder_);
    counts_.returns_masked += maskAirframe(settings_.airframe.parts, returns_);
    ++counts_.packets;
    segmenter_->add(returns_, sweep, arrival_s);
    return Taken::Yes;
}

}  // namespace hagen::streaming
