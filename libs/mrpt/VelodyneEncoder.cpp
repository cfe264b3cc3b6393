#include "mrpt/VelodyneEncoder.h"
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodynePacket.h>
#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using Packet = CObservationVelodyneScan::TVelodyneRawPacket;

constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr int kReturns = CObservationVelodyneScan::SCANS_PER_BLOCK;

/// Writes a packet byte by byte, little-endian, because the fields of MRPT's struct are private.
class PacketWriter {
 public:
    void put16(unsigned value) {
        bytes_.push_back(static_cast<std::uint8_t>(value & 0xff));
        bytes_.push_back(static_cast<std::uint8_t>(value >> 8));
    }
    void put8(unsigned value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }

    Packet packet() const {
        Packet packet;
        static_assert(sizeof packet == CObservationVelodyneScan::PACKET_SIZE);
        if (bytes_.size() != sizeof packet) throw std::logic_error("a packet has 1206 bytes");
        std::memcpy(static_cast<void*>(&packet), bytes_.data(), sizeof packet);
        return packet;
    }

 private:
    std::vector<std::uint8_t> bytes_;
};

unsigned distanceUnits(float range_m, const sensors::VelodyneModel& model) {
    const float units = std::round(range_m / model.distance_unit_m);
    return units >= 1.0f && units <= 65535.0f ? static_cast<unsigned>(units) : 0u;  // 0 for NaN
}

unsigned intensityUnits(float intensity) {
    if (!(intensity > 0.0f)) return 0;  // true for NaN
    return static_cast<unsigned>(std::lround(255.0f * std::min(intensity, 1.0f)));
}

unsigned azimuthUnits(double reading) {
    const long units = std::lround(reading) % CObservationVelodyneScan::ROTATION_MAX_UNITS;
    return static_cast<unsigned>(units < 0 ? units + CObservationVelodyneScan::ROTATION_MAX_UNITS
                                           : units);
}

void checkSizes(const sensors::VelodyneModel& model, const Firings& firings) {
    const auto fits = [&](const Image<float>& image) {
        return image.rows() == model.lasers && image.cols() == firings.range_m.cols();
    };
    const bool dual_fits = firings.last_range_m.size() == 0 || fits(firings.last_range_m);
    if (!fits(firings.range_m) || !fits(firings.intensity) || !dual_fits) {
        throw std::invalid_argument("firings of a " + model.name + " have " +
                                    std::to_string(model.lasers) +
                                    " lasers and one intensity per range");
    }
}

/// Returns the azimuth reading of a laser in a firing, neither rounded nor wrapped.
double readingOf(const sensors::VelodyneModel& model, const Firings& firings, int laser,
                 int firing) {
    const double turn = firing + model.delayUs(laser) / model.firing_period_us;
    return 100.0 * (firings.first_azimuth_deg + turn * firings.azimuth_step_deg);
}

}  // namespace

std::vector<Packet> encodePackets(const sensors::VelodyneModel& model, const Firings& firings) {
    checkSizes(model, firings);
    const bool dual = firings.last_range_m.size() != 0;
    const int at_once = model.blocksAtOnce(dual), used = model.usedBlocks(dual);
    const int firing_count = static_cast<int>(firings.range_m.cols());
    const int firings_per_packet = used / at_once * model.firings_per_block;

    std::vector<Packet> packets;
    for (int first = 0; first < firing_count; first += firings_per_packet) {
        PacketWriter bytes;
        for (int b = 0; b < kBlocks; ++b) {
            const int block_firing = first + b / at_once * model.firings_per_block;
            const int bank = b % at_once / (dual ? 2 : 1);
            // In dual mode, a block of last returns precedes a block of strongest returns.
            const auto& range_m = dual && b % 2 == 0 ? firings.last_range_m : firings.range_m;
            bytes.put16(b < used ? sensors::kBankHeaders[bank] : 0);
            bytes.put16(azimuthUnits(readingOf(model, firings, 0, block_firing)));
            for (int i = 0; i < kReturns; ++i) {
                const int laser = (kReturns * bank + i) % model.lasers;
                const int firing = block_firing + i / model.lasers;
                const bool fired = b < used && firing < firing_count;
                bytes.put16(fired ? distanceUnits(range_m(laser, firing), model) : 0);
                bytes.put8(fired ? intensityUnits(firings.intensity(laser, firing)) : 0);
            }
        }
        const auto time_us = static_cast<std::uint32_t>(
            std::fmod(firings.first_time_us + std::round(first * model.firing_period_us), 3600e6));
        bytes.put16(time_us & 0xffff);
        bytes.put16(time_us >> 16);
        bytes.put8(dual ? CObservationVelodyneScan::RETMODE_DUAL
                        : CObservationVelodyneScan::RETMODE_STRONGEST);
        bytes.put8(model.id);
        packets.push_back(bytes.packet());
    }
    return packets;
}

CObservationVelodyneScan::Ptr encodeScan(const sensors::VelodyneModel& model,
                                         const Firings& firings) {
    auto scan = CObservationVelodyneScan::Create();
    scan->scan_packets = encodePackets(model, firings);
    scan->calibration = mrptCalibration(sensors::defaultCalibration(model));
    scan->minRange = 0.5;
    scan->maxRange = 130.0;
    return scan;
}

}  // namespace hagen::observations
