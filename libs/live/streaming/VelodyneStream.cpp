#include <hagen/live/VelodyneStream.h>
#include <hagen/scan/Airframe.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/AppendReturn.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "live/streaming/CheckTime.h"

namespace hagen::live {
namespace {

using sensors::VelodynePacket;

constexpr std::size_t kMostLate = 16;
constexpr double kHourUs = 3600e6, kInterruptionUs = 50e3;
constexpr double kTurn_rad = 2 * kPi;
constexpr double kOverlap_rad = 0.2;  // of packets that are not full
constexpr double kNearest_m = 0.5;
constexpr int kBlocks = sensors::kVelodyneBlocks;
constexpr int kReadings = sensors::kReadingsOfTurn;
// In 0.01 degrees: of azimuths of a motor that hardly turns, and of one within a packet.
constexpr double kJitter = 10, kMostOff = 100;

/// From one time of the sensor's clock to another: within half an hour, since it wraps every hour.
double elapsedUs(double from_us, double to_us) { return std::remainder(to_us - from_us, kHourUs); }

/// Where the lasers look, by their corrections. A laser beside the axis sees what is near in
/// another direction than it points.
BeamOffsets offsetsOf(const sensors::VelodyneCalibration& calibration, double min_range_m) {
    BeamOffsets offsets;
    for (const sensors::VelodyneLaser& laser : calibration.lasers) {
        const double behind_rad = radians(std::remainder(laser.azimuth_deg, 360.0));
        const double sideways = laser.horizontal_offset_m / std::max(min_range_m, kNearest_m);
        const double beside_rad = std::asin(std::min(std::abs(sideways), 1.0));
        offsets.behind_rad = std::max(offsets.behind_rad, behind_rad + beside_rad);
        offsets.ahead_rad = std::max(offsets.ahead_rad, beside_rad - behind_rad);
    }
    return offsets;
}

int blocksPerFiring(const VelodynePacket& packet) {
    return packet.isDual() || sensors::isOfHdl64(packet.bytes.data()) ? 2 : 1;
}

/// -1: one of its blocks is unsound.
int azimuthOfFiring(const VelodynePacket& packet, int firing) {
    const int step = blocksPerFiring(packet);
    for (int b = firing * step; b < (firing + 1) * step; ++b) {
        if (packet.azimuthOf(b) < 0) return -1;
    }
    return packet.azimuthOf(firing * step);
}

/// How many returns the decoder finds in the first blocks.
std::size_t returnsBefore(const VelodynePacket& packet, int blocks) {
    std::size_t returns = 0;
    for (int b = 0; b < blocks; ++b) {
        if (packet.azimuthOf(b) < 0) continue;
        const std::uint8_t* const block =
            packet.bytes.data() + b * sensors::kVelodyneBlockBytes + sensors::kVelodyneHeaderBytes;
        for (std::size_t i = 0; i < sensors::kReturnsOfBlock; ++i) {
            returns += (block[3 * i] | block[3 * i + 1]) != 0;
        }
    }
    return returns;
}

/// Its bytes, with the time by the sensor's clock.
std::uint64_t keyOf(const VelodynePacket& packet) {
    const auto* const bytes = reinterpret_cast<const char*>(packet.bytes.data());
    return std::hash<std::string_view>()({bytes, packet.bytes.size()});
}

}  // namespace

VelodyneStream::VelodyneStream(const sensors::VelodyneModel& model, const Settings& settings,
                               StreamingSegmenter::Take take, const StreamingOptions& streaming,
                               const sensors::VelodyneCalibration* calibration)
    : model_(model),
      settings_(settings),
      calibration_(calibration != nullptr ? *calibration : sensors::defaultCalibration(model)) {
    const bool is_hdl64 = &model == &sensors::hdl64Model();
    if (is_hdl64 && calibration == nullptr) {
        throw std::invalid_argument("packets of an HDL-64E need its calibration");
    }
    SensorModel sensor = sensors::sensorOf(calibration_, model.name);
    const SensorModel limits = sensorModel(model.name);
    sensor.min_range_m = settings.sensor.min_range_m.value_or(limits.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(limits.max_range_m);
    filterFor(sensor, settings.options);  // throws SettingsError
    const BeamOffsets offsets = offsetsOf(calibration_, static_cast<double>(sensor.min_range_m));
    segmenter_ = std::make_unique<StreamingSegmenter>(std::move(sensor), settings.options,
                                                      std::move(take), streaming);
    segmenter_->setBeamOffsets(offsets);
    segmenter_->setMount(settings_.tiltOnLevelVehicle());
}

void VelodyneStream::setAttitude(const std::optional<Attitude>& attitude) {
    segmenter_->setAttitude(attitude);
}

void VelodyneStream::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    segmenter_->setPose(map_from_sensor);
}

/// The firings whose blocks are all sound, in runs that turn on as a sensor does. What an unsound
/// block would have seen is not known, so that no sweep goes over it.
void VelodyneStream::findRuns(const VelodynePacket& packet) {
    runs_.clear();
    int before = -1;  // azimuth of the firing before, if that is sound
    for (int f = 0; f < kBlocks / blocksPerFiring(packet); ++f) {
        const int azimuth = azimuthOfFiring(packet, f);
        const double step = std::remainder(azimuth - before, kReadings);
        const bool goes_on = before >= 0 && step > -kJitter &&
                             step * kBlocks < kReadings / 8.0 * blocksPerFiring(packet);
        if (azimuth >= 0 && goes_on) {
            ++runs_.back().end;
        } else if (azimuth >= 0) {
            runs_.push_back({f, f + 1});
        }
        before = azimuth;
    }
}

/// What a packet swept, as if all of its blocks were sound; the packets since the one before may be
/// lost. Leaves those runs that are where the sensor is by the longest one: others are broken
/// readings. Returns false if the packet has no sound block.
bool VelodyneStream::readSweep(const VelodynePacket& packet, double elapsed_us, Sweep& sweep) {
    findRuns(packet);
    const int step = blocksPerFiring(packet), all_firings = kBlocks / step;
    double from = -1, per_firing = 0;
    if (runs_.empty()) {  // halves of firings at most
        for (int b = kBlocks - 1; b >= 0; --b) {
            if (packet.azimuthOf(b) >= 0) from = packet.azimuthOf(b);
        }
        if (from < 0) return false;
    } else {
        const auto isShorter = [](const Run& a, const Run& b) {
            return a.end - a.first < b.end - b.first;
        };
        const Run longest = *std::max_element(runs_.begin(), runs_.end(), isShorter);
        const int first_azimuth = packet.azimuthOf(longest.first * step);
        const int turned = packet.azimuthOf(longest.end * step - 1) - first_azimuth;
        const int firings = longest.end - longest.first - 1;
        if (firings > 0) {
            per_firing = std::max(0.0, std::remainder(turned, kReadings)) / firings;
        }
        from = first_azimuth - per_firing * longest.first;
        const auto isElsewhere = [&](const Run& run) {
            const double expected = from + per_firing * run.first;
            const double off = azimuthOfFiring(packet, run.first) - expected;
            return std::abs(std::remainder(off, kReadings)) > kMostOff;
        };
        runs_.erase(std::remove_if(runs_.begin(), runs_.end(), isElsewhere), runs_.end());
    }
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

/// Each run is a sweep. Returns of other blocks have labels, too: they go with the run before.
void VelodyneStream::addRuns(const VelodynePacket& packet, const Sweep& sweep, double arrival_s) {
    const int step = blocksPerFiring(packet);
    if (runs_.empty()) {
        segmenter_->add(returns_, {sweep.from_rad, sweep.from_rad}, arrival_s);
        return;
    }
    if (runs_.size() == 1 && runs_[0].first == 0 && runs_[0].end == kBlocks / step) {
        segmenter_->add(returns_, sweep, arrival_s);
        return;
    }
    const double firing_rad = (sweep.to_rad - sweep.from_rad) * step / kBlocks;
    std::size_t taken = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
        const bool is_last = r + 1 == runs_.size();
        const int end_block = is_last ? kBlocks : runs_[r + 1].first * step;
        const std::size_t end = is_last ? returns_.size() : returnsBefore(packet, end_block);
        part_.clear();
        part_.beams = returns_.beams;
        for (; taken < end; ++taken) appendReturn(returns_, taken, part_);
        segmenter_->add(part_,
                        {sweep.from_rad + firing_rad * runs_[r].first,
                         sweep.from_rad + firing_rad * runs_[r].end},
                        arrival_s);
    }
}

VelodyneStream::Taken VelodyneStream::add(const std::uint8_t* bytes, std::size_t size,
                                          double arrival_s) {
    checkTime(arrival_s);
    if (!sensors::isVelodyneData(bytes, size)) {
        ++counts_.wrong_size;
        return Taken::WrongSize;
    }
    const bool is_hdl64 = &model_ == &sensors::hdl64Model();
    if (sensors::isOfHdl64(bytes) != is_hdl64 ||
        (!is_hdl64 && bytes[sensors::kVelodyneModelAt] != model_.id)) {
        ++counts_.other_model;
        return Taken::OtherModel;
    }
    VelodynePacket packet;
    std::copy_n(bytes, size, packet.bytes.begin());
    const double time_us = packet.sensorTimeUs();
    if (recent_.has(keyOf(packet), arrival_s)) {
        held_.clear();  // what comes late, comes by another path
        ++counts_.repeated;
        return Taken::Repeated;
    }
    // From the packet before to this one: as long as the one before lasted.
    const double period_us = model_.packetPeriodUs(has_last_ ? is_dual_ : packet.isDual());
    const bool is_too_late =
        has_last_ && elapsedUs(last_us_, time_us) < -static_cast<double>(kMostLate) * period_us;
    if (is_too_late) return hold(packet, arrival_s);
    held_.clear();
    return take(packet, arrival_s);
}

/// One packet that was under way for a turn must not count as what is there now. So many in a row
/// are no late ones: the sensor's clock was set.
VelodyneStream::Taken VelodyneStream::hold(const VelodynePacket& packet, double arrival_s) {
    held_.push_back({packet, arrival_s});
    ++counts_.late;
    ++counts_.too_late;
    if (held_.size() < kMostLate) return Taken::Late;
    counts_.late -= held_.size();
    counts_.too_late -= held_.size();
    ++counts_.interruptions;
    segmenter_->restart();
    has_last_ = false;
    Taken taken = Taken::Late;
    for (const auto& [held, held_s] : std::exchange(held_, {})) {
        taken = add(held.bytes.data(), held.bytes.size(), held_s);
    }
    return taken;
}

VelodyneStream::Taken VelodyneStream::take(const VelodynePacket& packet, double arrival_s) {
    const double time_us = packet.sensorTimeUs();
    const bool is_dual = packet.isDual();
    const double period_us = model_.packetPeriodUs(has_last_ ? is_dual_ : is_dual);
    const double elapsed_us = has_last_ ? elapsedUs(last_us_, time_us) : 0;
    if (elapsed_us > kInterruptionUs) {
        ++counts_.interruptions;
        if (elapsed_us < 1e6) {
            counts_.lost += static_cast<std::size_t>(std::lround(elapsed_us / period_us)) - 1;
        }
        segmenter_->flush();
        if (elapsed_us > 1e6 * segmenter_->streaming().context_s) {
            segmenter_->restart();
            has_last_ = false;
        }
    }
    Sweep sweep{};
    if (!readSweep(packet, elapsed_us, sweep)) {
        ++counts_.unsound;
        return Taken::Unsound;
    }
    recent_.add(keyOf(packet), arrival_s);
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
    addRuns(packet, sweep, arrival_s);
    return Taken::Yes;
}

}  // namespace hagen::live
