#include "support/PlainVelodyneDecoder.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneModel.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hagen::test {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using mrpt::obs::VelodyneCalibration;

constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr int kTurn = CObservationVelodyneScan::ROTATION_MAX_UNITS;  // 0.01 degrees
constexpr double kHourUs = 3600e6;

/// A raw packet, read byte by byte (little-endian), because MRPT's struct is packed and its
/// accessors bind references to unaligned numbers.
class Packet {
 public:
    explicit Packet(const CObservationVelodyneScan::TVelodyneRawPacket& raw)
        : bytes_(reinterpret_cast<const std::uint8_t*>(&raw)) {}

    bool isSound(int block, unsigned bank = 0) const {
        return number(block * kBlockBytes, 2) == 0xeeff - 0x1100 * bank && azimuth(block) < kTurn;
    }
    int azimuth(int block) const { return static_cast<int>(number(block * kBlockBytes + 2, 2)); }
    unsigned distance(int block, int i) const { return number(returnAt(block, i), 2); }
    unsigned intensity(int block, int i) const { return bytes_[returnAt(block, i) + 2]; }
    unsigned time_us() const { return number(kBlocks * kBlockBytes, 4); }
    int blocksPerFiring() const {
        return bytes_[kBlocks * kBlockBytes + 4] == CObservationVelodyneScan::RETMODE_DUAL ? 2 : 1;
    }
    std::uint8_t modelId() const { return bytes_[kBlocks * kBlockBytes + 5]; }

 private:
    static constexpr int kBlockBytes = CObservationVelodyneScan::SIZE_BLOCK;
    static int returnAt(int block, int i) { return block * kBlockBytes + 4 + 3 * i; }
    unsigned number(int at, int bytes) const {
        unsigned value = 0;
        for (int i = 0; i < bytes; ++i) value |= unsigned{bytes_[at + i]} << (8 * i);
        return value;
    }

    const std::uint8_t* bytes_;
};

int wrapTurn(int reading) { return ((reading % kTurn) + kTurn) % kTurn; }

/// A direction in the horizontal plane.
struct Azimuth {
    float sine, cosine;  ///< of the clockwise angle from x
    float azimuth_rad;   ///< counter-clockwise from x, as in MRPT
};

/// The directions of all azimuth readings, with interpolation.
class AzimuthTable {
 public:
    AzimuthTable() {
        for (int reading = 0; reading < kTurn; ++reading) {
            const double clockwise_rad = radians(sensors::azimuthOfReadingDeg(reading));
            entries_[reading] = {static_cast<float>(std::sin(clockwise_rad)),
                                 static_cast<float>(std::cos(clockwise_rad)),
                                 static_cast<float>(-clockwise_rad)};
        }
    }

    /// Rotates the nearest entry by the remainder of at most 0.005 degrees, for which sin(d) = d
    /// and cos(d) = 1 within 4e-9.
    Azimuth operator()(float reading) const {
        const float nearest = std::round(reading);
        const float rest_rad = (reading - nearest) * static_cast<float>(radians(0.01));
        const Azimuth& entry = entries_[wrapTurn(static_cast<int>(nearest))];
        return {entry.sine + entry.cosine * rest_rad, entry.cosine - entry.sine * rest_rad,
                entry.azimuth_rad - rest_rad};
    }

 private:
    std::array<Azimuth, kTurn> entries_;
};

const VelodyneCalibration& calibrationOf(const CObservationVelodyneScan& observation,
                                         const sensors::VelodyneModel& model) {
    const bool has_own =
        observation.calibration.laser_corrections.size() == static_cast<std::size_t>(model.lasers);
    if (has_own) return observation.calibration;
    static VelodyneCalibration of_model;
    of_model = observations::mrptCalibration(sensors::defaultCalibration(model));
    return of_model;
}

/// The sensor's rotation between the blocks of consecutive firings, in 0.01 degrees. The median
/// over the scan prevents rounded azimuths and broken blocks from shifting returns.
int turnOfBlocks(const CObservationVelodyneScan& observation, int banks) {
    std::vector<int> turns;
    const auto compare = [&](const Packet& from, int a, const Packet& to, int b) {
        if (!from.isSound(a) || !to.isSound(b)) return;
        const int turn = wrapTurn(to.azimuth(b) - from.azimuth(a));
        turns.push_back(turn > kTurn / 2 ? turn - kTurn : turn);
    };
    for (std::size_t p = 0; p < observation.scan_packets.size(); ++p) {
        const Packet packet(observation.scan_packets[p]);
        const int step = banks * packet.blocksPerFiring();
        for (int b = 0; b + step < kBlocks; ++b) compare(packet, b, packet, b + step);
        if (p > 0 && step == 8) compare(Packet(observation.scan_packets[p - 1]), 0, packet, 0);
    }
    if (turns.empty()) return 0;
    const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
    std::nth_element(turns.begin(), middle, turns.end());
    return std::max(0, *middle);
}

/// A laser's calibration for the decoder.
struct Laser {
    float sine, cosine;                  ///< of the laser's elevation
    float distance_m, up_m, sideways_m;  ///< added to the measurement
    double azimuth_reading;              ///< subtracted from the azimuth, 0.01 degrees
    std::uint8_t row;
};

std::vector<Laser> lasersOf(const VelodyneCalibration& calibration) {
    sensors::VelodyneCalibration readable;
    observations::readCalibration(calibration, readable);
    const std::vector<std::uint8_t> rows = sensors::rowsOfLasers(readable);
    std::vector<Laser> lasers;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& correction = calibration.laser_corrections[i];
        lasers.push_back({static_cast<float>(correction.sinVertCorrection),
                          static_cast<float>(correction.cosVertCorrection),
                          static_cast<float>(correction.distanceCorrection),
                          static_cast<float>(correction.verticalOffsetCorrection),
                          static_cast<float>(correction.horizontalOffsetCorrection),
                          100.0 * correction.azimuthCorrection, rows[i]});
    }
    return lasers;
}

/// Appends the position of a return: coordinates, range, azimuth and row.
void appendReturn(const Laser& laser, double reading, float distance_m, Scan& scan) {
    static const AzimuthTable azimuths;
    const Azimuth azimuth = azimuths(static_cast<float>(reading - laser.azimuth_reading));
    const float range_m = distance_m + laser.distance_m;
    const float horizontal_m = range_m * laser.cosine + laser.up_m * laser.sine;
    scan.x_m.push_back(horizontal_m * azimuth.cosine + laser.sideways_m * azimuth.sine);
    scan.y_m.push_back(-horizontal_m * azimuth.sine + laser.sideways_m * azimuth.cosine);
    scan.z_m.push_back(range_m * laser.sine + laser.up_m);
    scan.range_m.push_back(range_m);
    scan.azimuth_rad.push_back(azimuth.azimuth_rad);
    scan.row.push_back(laser.row);
}

}  // namespace

std::size_t decodePlainly(const CObservationVelodyneScan& observation, Scan& scan) {
    scan.clear();
    if (observation.scan_packets.empty()) return 0;
    const sensors::VelodyneModel& model =
        *sensors::findVelodyneModel(Packet(observation.scan_packets.front()).modelId());
    const std::vector<Laser> lasers = lasersOf(calibrationOf(observation, model));
    const int banks = model.name == "VLS-128" ? 4 : 1;
    const int turn = turnOfBlocks(observation, banks);
    const float unit_m = model.name == "VLP-32C" || banks == 4 ? 0.004f : 0.002f;
    const unsigned first_us = Packet(observation.scan_packets.front()).time_us();
    scan.reserve(observation.scan_packets.size() * CObservationVelodyneScan::SCANS_PER_PACKET);

    std::size_t unsound_blocks = 0;
    for (std::size_t p = 0; p < observation.scan_packets.size(); ++p) {
        const Packet packet(observation.scan_packets[p]);
        double packet_us = static_cast<double>(packet.time_us()) - first_us;
        if (packet_us < 0) packet_us += kHourUs;  // time stamps wrap around every hour
        const int returns = packet.blocksPerFiring(), at_once = banks * returns;
        for (int b = 0; b < (at_once == 8 ? 8 : kBlocks); ++b) {
            const int bank = b % at_once / returns;
            if (!packet.isSound(b, static_cast<unsigned>(bank))) {
                ++unsound_blocks;
                continue;
            }
            const double block_us = packet_us + b / at_once * model.blockPeriodUs();
            for (int i = 0; i < CObservationVelodyneScan::SCANS_PER_BLOCK; ++i) {
                if (packet.distance(b, i) == 0) continue;  // no return
                const int laser = (32 * bank + i) % model.lasers;
                const double turn_in_block = model.turnWithinBlock(i / model.lasers, laser);
                appendReturn(lasers[laser], packet.azimuth(b) + turn * turn_in_block,
                             static_cast<float>(packet.distance(b, i)) * unit_m, scan);
                scan.intensity.push_back(static_cast<float>(packet.intensity(b, i)) / 255.0f);
                scan.time_s.push_back(
                    static_cast<float>(1e-6 * (block_us + turn_in_block * model.blockPeriodUs())));
            }
        }
    }
    return unsound_blocks;
}

}  // namespace hagen::test
