#include <array>
#include <cmath>
#include <cstdio>
#include <hagen/observations/VelodyneDecoder.h>
#include <hagen/observations/VelodyneModel.h>
#include <hagen/range_image/Angle.h>
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

/// Sine, cosine and azimuth (counter-clockwise, as MRPT has it) of each azimuth a packet can name
/// (clockwise, 0.01 degrees).
struct AzimuthTable {
    std::array<float, kTurn> sine, cosine, azimuth_rad;

    AzimuthTable() {
        for (int i = 0; i < kTurn; ++i) {
            const double clockwise_rad = radians(0.01 * i);
            sine[i] = static_cast<float>(std::sin(clockwise_rad));
            cosine[i] = static_cast<float>(std::cos(clockwise_rad));
            azimuth_rad[i] =
                static_cast<float>(clockwise_rad < kPi ? -clockwise_rad : 2 * kPi - clockwise_rad);
        }
    }
};

const AzimuthTable& azimuthTable() {
    static const AzimuthTable table;
    return table;
}

int wrapTurn(int hundredths_deg) { return ((hundredths_deg % kTurn) + kTurn) % kTurn; }

std::string hex(unsigned value) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%02x", value);
    return text;
}

const VelodyneModel& modelOf(const CObservationVelodyneScan& observation, std::size_t packet) {
    const std::uint8_t id = observation.scan_packets[packet].velodyne_model_ID;
    const VelodyneModel* model = findVelodyneModel(id);
    if (model == nullptr) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": unknown model id " + hex(id) +
                                 "; known are VLP-16 (0x22) and HDL-32E (0x21)");
    }
    if (id != observation.scan_packets.front().velodyne_model_ID) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": model id " + hex(id) +
                                 " differs from the first packet's");
    }
    return *model;
}

const VelodyneCalibration& calibrationOf(const CObservationVelodyneScan& observation,
                                         const VelodyneModel& model) {
    const bool has_own = observation.calibration.laser_corrections.size() ==
                         static_cast<std::size_t>(model.lasers);
    return has_own ? observation.calibration
                   : VelodyneCalibration::LoadDefaultCalibration(model.calibration);
}

bool isSound(const CObservationVelodyneScan::raw_block_t& block) {
    return block.header() == CObservationVelodyneScan::UPPER_BANK && block.rotation() < kTurn;
}

/// How far the sensor turns during each block, in 0.01 degrees: to the block after it (in dual mode
/// after its pair). The last one has none after it and turns as the one before.
std::array<int, kBlocks> turnsOf(const Packet& packet, int blocks_per_firing) {
    std::array<int, kBlocks> turns{};
    for (int b = 0; b < kBlocks; ++b) {
        const int next = b + blocks_per_firing;
        turns[b] = next < kBlocks
                       ? wrapTurn(packet.blocks[next].rotation() - packet.blocks[b].rotation())
                       : turns[b - blocks_per_firing];
    }
    return turns;
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

    std::size_t unsound_blocks = 0;
    const double first_us = observation.scan_packets.front().gps_timestamp();
    for (std::size_t p = 0; p < observation.scan_packets.size(); ++p) {
        modelOf(observation, p);
        const Packet& packet = observation.scan_packets[p];
        const bool dual = packet.laser_return_mode == CObservationVelodyneScan::RETMODE_DUAL;
        const int blocks_per_firing = dual ? 2 : 1;
        const std::array<int, kBlocks> turns = turnsOf(packet, blocks_per_firing);
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
                const int azimuth = wrapTurn(
                    static_cast<int>(std::lround(block.rotation() + turns[b] * turn_in_block -
                                                 100.0 * correction.azimuthCorrection)));
                const float range_m = static_cast<float>(
                    laser_return.distance() * CObservationVelodyneScan::DISTANCE_RESOLUTION +
                    correction.distanceCorrection);
                const float horizontal_m =
                    range_m * static_cast<float>(correction.cosVertCorrection) +
                    static_cast<float>(correction.verticalOffsetCorrection *
                                       correction.sinVertCorrection);
                const float sideways_m = static_cast<float>(correction.horizontalOffsetCorrection);
                const float sine = table.sine[azimuth], cosine = table.cosine[azimuth];
                scan.x_m.push_back(horizontal_m * cosine + sideways_m * sine);
                scan.y_m.push_back(-horizontal_m * sine + sideways_m * cosine);
                scan.z_m.push_back(range_m * static_cast<float>(correction.sinVertCorrection) +
                                   static_cast<float>(correction.verticalOffsetCorrection));
                scan.intensity.push_back(static_cast<float>(laser_return.intensity()) / 255.0f);
                scan.range_m.push_back(range_m);
                scan.azimuth_rad.push_back(table.azimuth_rad[azimuth]);
                scan.row.push_back(rows[laser]);
                scan.time_s.push_back(
                    static_cast<float>(1e-6 * (block_us + turn_in_block * model.blockPeriodUs())));
            }
        }
    }
    return unsound_blocks;
}

}  // namespace hagen
