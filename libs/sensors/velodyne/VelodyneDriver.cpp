#include <hagen/scan/Angle.h>
#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>
#include "scan/AppendReturn.h"
#include "sensors/velodyne/AzimuthView.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "sensors/RecentPackets.h"

namespace hagen::sensors {
namespace {

constexpr int kMaxLate = 16;
constexpr double kInterruptionUs = 50e3;
constexpr double kTwoTurnsUs = 450e3;   // at 5 Hz
constexpr double kForgottenUs = 250e3;  // earlier returns are no longer used as context
constexpr double kOverlap_rad = 0.2;    // tolerated overlap of packets
constexpr double kNearest_m = 0.5;
constexpr int kReadings = kReadingsOfTurn;
// Azimuth jitter of a nearly stationary motor, and max. deviation within a packet, in 0.01 degrees.
constexpr double kJitter = 10, kMaxOff = 100;
constexpr double kMaxTurnBetweenPackets = 100;  // of a VLS-128 in dual mode: 38 at 20 Hz

/// Azimuth of a firing of `step` blocks; -1 if one of them is invalid.
int azimuthOfFiring(const VelodynePacket& packet, int firing, int step) {
    for (int b = firing * step; b < (firing + 1) * step; ++b) {
        if (packet.azimuthOf(b) < 0) return -1;
    }
    return packet.azimuthOf(firing * step);
}

/// Number of returns decoded from the first `blocks` blocks.
std::size_t returnsBefore(const VelodynePacket& packet, int blocks) {
    std::size_t returns = 0;
    for (int b = 0; b < blocks; ++b) {
        if (packet.azimuthOf(b) < 0) continue;
        const std::uint8_t* const block =
            packet.bytes.data() + b * kVelodyneBlockBytes + kVelodyneHeaderBytes;
        for (std::size_t i = 0; i < kReturnsOfBlock; ++i) {
            returns += (block[3 * i] | block[3 * i + 1]) != 0;
        }
    }
    return returns;
}

/// Hash of the packet, which includes the sensor time.
std::uint64_t keyOf(const VelodynePacket& packet) {
    const auto* const bytes = reinterpret_cast<const char*>(packet.bytes.data());
    return std::hash<std::string_view>()({bytes, packet.bytes.size()});
}

/// Reads the packets of one Velodyne. Gaps of more than 50 ms, except silent sectors, and clock
/// jumps are interruptions.
class VelodyneDriver : public LidarDriver {
 public:
    explicit VelodyneDriver(const VelodyneModel& model, const VelodyneCalibration* calibration)
        : model_(model),
          calibration_(calibration != nullptr ? *calibration : defaultCalibration(model)),
          turn_between_packets_(model.blocksAtOnce(true) == model.usedBlocks(true)
                                    ? kReadings * model.packetPeriodUs(true) / 100e3
                                    : 0) {
        if (&model == &hdl64Model() && calibration == nullptr) {
            throw std::invalid_argument("HDL-64E packets require a calibration");
        }
    }

    SensorModel sensor() const override {
        SensorModel sensor = sensorOf(calibration_, model_.name);
        const SensorModel limits = sensorModel(model_.name);
        sensor.min_range_m = limits.min_range_m;
        sensor.max_range_m = limits.max_range_m;
        return sensor;
    }

    /// From the calibration: a laser beside the axis sees near objects in another direction than
    /// its beam's.
    BeamOffsets beamOffsets(double min_range_m) const override {
        BeamOffsets offsets;
        for (const VelodyneLaser& laser : calibration_.lasers) {
            const double behind_rad = radians(std::remainder(laser.azimuth_deg, 360.0));
            const double sideways = laser.horizontal_offset_m / std::max(min_range_m, kNearest_m);
            const double beside_rad = std::asin(std::min(std::abs(sideways), 1.0));
            offsets.behind_rad = std::max(offsets.behind_rad, behind_rad + beside_rad);
            offsets.ahead_rad = std::max(offsets.ahead_rad, beside_rad - behind_rad);
        }
        return offsets;
    }

    bool isDual() const override { return is_dual_; }
    double view_rad() const override { return kTurn_rad - radians(0.01 * silence_.width); }
    bool isData(const Datagram& datagram) const override {
        return isVelodyneData(datagram.bytes, datagram.size) &&
               velodyneModelOf(datagram.bytes) == &model_;
    }

    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override {
        if (datagram.size == kPositionBytes) {
            ++counts_.auxiliary;
            return Taken::Auxiliary;
        }
        if (!isVelodyneData(datagram.bytes, datagram.size)) {
            ++counts_.wrong_size;
            return Taken::WrongSize;
        }
        if (velodyneModelOf(datagram.bytes) != &model_) {
            ++counts_.other_sensor;
            return Taken::OtherSensor;
        }
        VelodynePacket packet;
        std::copy_n(datagram.bytes, datagram.size, packet.bytes.begin());
        return addPacket(packet, arrival_s, sink);
    }

 private:
    /// Consecutive valid firings of a packet.
    struct Run {
        int first, end;
    };

    Taken addPacket(const VelodynePacket& packet, double arrival_s, ReturnSink& sink) {
        if (recent_.has(keyOf(packet), arrival_s)) {
            late_in_a_row_ = 0;  // late packets take another network path
            ++counts_.duplicate;
            return Taken::Duplicate;
        }
        // The period depends on the previous packet's mode.
        const double period_us = model_.packetPeriodUs(has_last_ ? is_dual_ : packet.isDual());
        const bool is_too_late =
            has_last_ && elapsedUs(last_us_, packet.sensorTimeUs()) < -kMaxLate * period_us;
        if (is_too_late) {
            // A packet that is a turn late is stale, but so many in a row mean that the clock was
            // set.
            if (++late_in_a_row_ < kMaxLate) {
                ++counts_.late;
                ++counts_.too_late;
                return Taken::TooLate;
            }
            ++counts_.interruptions;
            sink.restart();
            has_last_ = false;
        }
        late_in_a_row_ = 0;
        return take(packet, arrival_s, sink);
    }

    Taken take(const VelodynePacket& packet, double arrival_s, ReturnSink& sink) {
        const double time_us = packet.sensorTimeUs();
        const bool is_dual = packet.isDual();
        const double period_us = model_.packetPeriodUs(has_last_ ? is_dual_ : is_dual);
        const double elapsed_us = has_last_ ? elapsedUs(last_us_, time_us) : 0;
        const double silent =
            elapsed_us > kForgottenUs ? 0 : silence_.shareOf(last_azimuth_, packet.azimuth());
        const double sending_us = elapsed_us * (1 - silent);
        if (silent > 0 && elapsed_us > 0) sink.flush();
        if (sending_us > kInterruptionUs) {
            ++counts_.interruptions;
            if (elapsed_us < 1e6) {
                counts_.lost += static_cast<std::size_t>(std::lround(sending_us / period_us)) - 1;
            }
            sink.flush();
            if (elapsed_us > kForgottenUs) {
                sink.restart();
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
            if (has_last_ && sending_us > 1.5 * period_us && sending_us <= kInterruptionUs) {
                counts_.lost += static_cast<std::size_t>(std::lround(sending_us / period_us)) - 1;
            }
            if (has_last_) {
                counts_.scans += static_cast<std::size_t>(
                    std::max(0.0, std::floor(sweep.from_rad / kTurn_rad) -
                                      std::floor(last_sweep_.from_rad / kTurn_rad)));
            }
            learnView(packet, time_us);
            last_us_ = time_us;
            last_azimuth_ = packet.azimuth();
            last_sweep_ = sweep;
            has_last_ = true;
        }
        counts_.unsound_blocks +=
            decodePackets({packet.bytes.data(), 1}, calibration_, returns_, decoder_,
                          static_cast<int>(std::lround(turn_between_packets_)));
        ++counts_.packets;
        addRuns(packet, sweep, arrival_s, sink);
        return Taken::Yes;
    }

    /// Updates the silent sector after each skipped part of a turn, and at least every two turns.
    void learnView(const VelodynePacket& packet, double time_us) {
        if (!has_last_) view_start_us_ = time_us;
        const std::size_t skips = view_.skips();
        view_.add(packet);
        const bool is_over = std::abs(elapsedUs(view_start_us_, time_us)) > kTwoTurnsUs;
        if (is_over || view_.skips() > skips) silence_ = view_.silence().value_or(silence_);
        if (!is_over) return;
        view_ = AzimuthView();
        view_start_us_ = time_us;
    }

    int blocksPerFiring(const VelodynePacket& packet) const {
        return model_.blocksAtOnce(packet.isDual());
    }

    /// Finds runs of firings with valid blocks and steady rotation. No sweep covers an invalid
    /// block, because its direction is unknown.
    void findRuns(const VelodynePacket& packet) {
        runs_.clear();
        int before = -1;  // azimuth of the previous firing; -1 if invalid
        for (int f = 0; f < kVelodyneBlocks / blocksPerFiring(packet); ++f) {
            const int azimuth = azimuthOfFiring(packet, f, blocksPerFiring(packet));
            const double step = std::remainder(azimuth - before, kReadings);
            const bool goes_on = before >= 0 && step > -kJitter &&
                                 step * kVelodyneBlocks < kReadings / 8.0 * blocksPerFiring(packet);
            if (azimuth >= 0 && goes_on) {
                ++runs_.back().end;
            } else if (azimuth >= 0) {
                runs_.push_back({f, f + 1});
            }
            before = azimuth;
        }
    }

    /// Finds the azimuth range of a packet, as if all of its blocks were valid; previous packets
    /// may be lost. Keeps the runs consistent with the longest run; others have broken readings.
    /// Returns false if the packet has no valid block.
    bool readSweep(const VelodynePacket& packet, double elapsed_us, Sweep& sweep) {
        findRuns(packet);
        const int step = blocksPerFiring(packet), all_firings = kVelodyneBlocks / step;
        double from = -1, per_firing = 0;
        if (runs_.empty()) {  // no complete valid firing
            for (int b = kVelodyneBlocks - 1; b >= 0; --b) {
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
                const double off = azimuthOfFiring(packet, run.first, step) - expected;
                return std::abs(std::remainder(off, kReadings)) > kMaxOff;
            };
            runs_.erase(std::remove_if(runs_.begin(), runs_.end(), isElsewhere), runs_.end());
        }
        if (all_firings == 1) {
            // Packets with one firing show the rotation only by their successors.
            const double packets = elapsed_us / model_.packetPeriodUs(packet.isDual());
            if (packets > 0.5 && packets < 10) {
                const double last = 100 * degrees(last_sweep_.from_rad);
                const double turn = std::max(0.0, std::remainder(from - last, kReadings) / packets);
                if (turn < kMaxTurnBetweenPackets) turn_between_packets_ = turn;
            }
            per_firing = turn_between_packets_;
        }
        const double swept_rad = radians(0.01 * per_firing * all_firings);
        sweep.from_rad = radians(0.01 * from);
        if (has_last_) {
            // Ignore whole missing turns, so that earlier returns are not overwritten.
            const double period_us = model_.packetPeriodUs(packet.isDual());
            double turned_rad = std::remainder(elapsed_us / period_us * swept_rad, kTurn_rad);
            if (elapsed_us > 0 && turned_rad < -kOverlap_rad) turned_rad += kTurn_rad;
            const double expected_rad = last_sweep_.from_rad + turned_rad;
            sweep.from_rad =
                expected_rad + std::remainder(sweep.from_rad - expected_rad, kTurn_rad);
        }
        sweep.to_rad = sweep.from_rad + swept_rad;
        return true;
    }

    /// Adds each run as a sweep. Returns of other blocks join the previous run, because they need
    /// labels too.
    void addRuns(const VelodynePacket& packet, const Sweep& sweep, double arrival_s,
                 ReturnSink& sink) {
        const int step = blocksPerFiring(packet);
        if (runs_.empty()) {
            sink.add(returns_, {sweep.from_rad, sweep.from_rad}, arrival_s);
            return;
        }
        if (runs_.size() == 1 && runs_[0].first == 0 && runs_[0].end == kVelodyneBlocks / step) {
            sink.add(returns_, sweep, arrival_s);
            return;
        }
        const double firing_rad = (sweep.to_rad - sweep.from_rad) * step / kVelodyneBlocks;
        std::size_t taken = 0;
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            const bool is_last = r + 1 == runs_.size();
            const int end_block = is_last ? kVelodyneBlocks : runs_[r + 1].first * step;
            const std::size_t end = is_last ? returns_.size() : returnsBefore(packet, end_block);
            part_.clear();
            part_.beams = returns_.beams;
            for (; taken < end; ++taken) appendReturn(returns_, taken, part_);
            sink.add(part_,
                     {sweep.from_rad + firing_rad * runs_[r].first,
                      sweep.from_rad + firing_rad * runs_[r].end},
                     arrival_s);
        }
    }

    const VelodyneModel& model_;
    VelodyneCalibration calibration_;
    DecoderWorkspace decoder_;
    Scan returns_, part_;
    std::vector<Run> runs_;
    RecentPackets recent_;
    int late_in_a_row_ = 0;
    bool has_last_ = false, is_dual_ = false;
    double last_us_ = 0;  ///< sensor time of the latest packet
    int last_azimuth_ = -1;
    AzimuthView view_;
    SilentSector silence_;
    double view_start_us_ = 0;
    Sweep last_sweep_{};
    double turn_between_packets_;  ///< 0.01 degrees; 0 if packets have several firings
};

}  // namespace

std::unique_ptr<LidarDriver> makeVelodyneDriver(const VelodyneModel& model,
                                                const VelodyneCalibration* calibration) {
    return std::make_unique<VelodyneDriver>(model, calibration);
}

}  // namespace hagen::sensors
