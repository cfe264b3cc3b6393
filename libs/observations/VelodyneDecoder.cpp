#include <hagen/observations/VelodyneDecoder.h>
#include <hagen/observations/VelodyneModel.h>
#include <hagen/range_image/Angle.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace hagen {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using mrpt::obs::VelodyneCalibration;
using Packet = CObservationVelodyneScan::TVelodyneRawPacket;

constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr int kTurn = CObservationVelodyneScan::ROTATION_MAX_UNITS;  // 0.01 degrees
constexpr double kHourUs = 3600e6;

int wrapTurn(int reading) { return ((reading % kTurn) + kTurn) % kTurn; }

/// A direction in the plane.
struct Azimuth {
    float sine, cosine;  ///< of the angle clockwise from x
    float azimuth_rad;   ///< counter-clockwise from x, as MRPT has it
};

/// The directions of all azimuths that a packet can name, and of those between them.
class AzimuthTable {
 public:
    AzimuthTable() {
        for (int reading = 0; reading < kTurn; ++reading) {
            const double clockwise_rad = radians(azimuthOfReadingDeg(reading));
            entries_[reading] = {static_cast<float>(std::sin(clockwise_rad)),
                                 static_cast<float>(std::cos(clockwise_rad)),
                                 static_cast<float>(-clockwise_rad)};
        }
    }

    /// The nearest entry, turned by what is left: at most 0.005 degrees, where sin(d) = d and
    /// cos(d) = 1 to 4e-9.
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

const AzimuthTable& azimuthTable() {
    static const AzimuthTable table;
    return table;
}

std::string hex(unsigned value) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%02x", value);
    return text;
}

const VelodyneModel& modelOf(const CObservationVelodyneScan& observation, std::size_t packet) {
    const std::uint8_t id = observation.scan_packets[packet].velodyne_model_ID;
    const VelodyneModel* model = findVelodyneModel(id);
    if (model == nullptr) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": unknown model id " +
                                 hex(id) + "; known are VLP-16 (0x22) and HDL-32E (0x21)");
    }
    if (id != observation.scan_packets.front().velodyne_model_ID) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": model id " + hex(id) +
                                 " differs from the first packet's");
    }
    return *model;
}

const VelodyneCalibration& calibrationOf(const CObservationVelodyneScan& observation,
                                         const VelodyneModel& model) {
    const bool has_own =
        observation.calibration.laser_corrections.size() == static_cast<std::size_t>(model.lasers);
    return has_own ? observation.calibration
                   : VelodyneCalibration::LoadDefaultCalibration(model.calibration);
}

bool isSound(const CObservationVelodyneScan::raw_block_t& block) {
    return block.header() == CObservationVelodyneScan::UPPER_BANK && block.rotation() < kTurn;
}

int blocksPerFiring(const Packet& packet) {
    return packet.laser_return_mode == CObservationVelodyneScan::RETMODE_DUAL ? 2 : 1;
}

/// How far the sensor turns from one firing's block to the next, in 0.01 degrees: the median over
/// the scan, so that neither the rounding of azimuths nor a broken block shifts a return.
int turnOfBlocks(const std::vector<Packet>& packets) {
    std::vector<int> turns;
    for (const Packet& packet : packets) {
        const int step = blocksPerFiring(packet);
        for (int b = 0; b + step < kBlocks; ++b) {
            turns.push_back(
                wrapTurn(packet.blocks[b + step].rotation() - packet.blocks[b].rotation()));
        }
    }
    const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
    std::nth_element(turns.begin(), middle, turns.end());
    return *middle;
}

}  // namespace

SensorModel sensorOf(const CObservationVelodyneScan& observation) {
    if (observation.scan_packets.empty()) throw std::runtime_error("the scan has no packets");
    const VelodyneModel& model = modelOf(observation, 0);
    SensorModel sensor = sensorOf(calibrationOf(observation, model), model.name);
    sensor.min_range_m = static_cast<float>(observation.minRange);
    sensor.max_range_m = static_cast<float>(observation.maxRange);
    return sensor;
}

std::size_t decodePackets(const CObservationVelodyneScan& observation, Scan& scan) {
    scan.clear();
    if (observation.scan_packets.empty()) return 0;
    const VelodyneModel& model = modelOf(observation, 0);
    const VelodyneCalibration& calibration = calibrationOf(observation, model);
    const std::vector<std::uint8_t> rows = rowsOfLasers(calibration);
    const AzimuthTable& table = azimuthTable();
    scan.reserve(observation.scan_packets.size() * CObservationVelodyneScan::SCANS_PER_PACKET);

    const int turn = turnOfBlocks(observation.scan_packets);
    std::size_t unsound_blocks = 0;
    const double first_us = observation.scan_packets.front().gps_timestamp();
    for (std::size_t p = 0; p < observation.scan_packets.size(); ++p) {
        modelOf(observation, p);
        const Packet& packet = observation.scan_packets[p];
        const int blocks_per_firing = blocksPerFiring(packet);
        double packet_us = packet.gps_timestamp() - first_us;
        if (packet_us < 0) packet_us += kHourUs;  // time stamps start anew every hour

        for (int b = 0; b < kBlocks; ++b) {
            const auto& block = packet.blocks[b];
            if (!isSound(block)) {
                ++unsound_blocks;
                continue;
            }
            const double block_us = packet_us + b / blocks_per_firing * model.blockPeriodUs();
            for (int i = 0; i < CObservationVelodyneScan::SCANS_PER_BLOCK; ++i) {
                const auto& laser_return = block.laser_returns[i];
                if (laser_return.distance() == 0) continue;  // nothing came back
                const int laser = i % model.lasers;
                const auto& correction = calibration.laser_corrections[laser];
                const double turn_in_block = model.turnWithinBlock(i / model.lasers, laser);
                const Azimuth azimuth =
                    table(static_cast<float>(block.rotation() + turn * turn_in_block -
                                             100.0 * correction.azimuthCorrection));
                const float range_m = static_cast<float>(
                    laser_return.distance() * CObservationVelodyneScan::DISTANCE_RESOLUTION +
                    correction.distanceCorrection);
                const float horizontal_m =
                    range_m * static_cast<float>(correction.cosVertCorrection) +
                    static_cast<float>(correction.verticalOffsetCorrection *
                                       correction.sinVertCorrection);
                const float sideways_m = static_cast<float>(correction.horizontalOffsetCorrection);
                scan.x_m.push_back(horizontal_m * azimuth.cosine + sideways_m * azimuth.sine);
                scan.y_m.push_back(-horizontal_m * azimuth.sine + sideways_m * azimuth.cosine);
                scan.z_m.push_back(range_m * static_cast<float>(correction.sinVertCorrection) +
                                   static_cast<float>(correction.verticalOffsetCorrection));
                scan.intensity.push_back(static_cast<float>(laser_return.intensity()) / 255.0f);
                scan.range_m.push_back(range_m);
                scan.azimuth_rad.push_back(azimuth.azimuth_rad);
                scan.row.push_back(rows[laser]);
                scan.time_s.push_back(
                    static_cast<float>(1e-6 * (block_us + turn_in_block * model.blockPeriodUs())));
            }
        }
    }
    return unsound_blocks;
}

}  // namespace hagen
