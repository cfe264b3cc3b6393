#include <hagen/mrpt/VelodyneObservation.h>

#include <hagen/sensors/VelodynePacket.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;

sensors::VelodynePackets packetsOf(const CObservationVelodyneScan& observation) {
    const auto& raw = observation.scan_packets;
    static_assert(sizeof(CObservationVelodyneScan::TVelodyneRawPacket) ==
                  sensors::kVelodynePacketBytes);
    return {reinterpret_cast<const std::uint8_t*>(raw.data()), raw.size()};
}

}  // namespace

void readCalibration(const mrpt::obs::VelodyneCalibration& of_observation,
                     sensors::VelodyneCalibration& calibration) {
    calibration.lasers.clear();
    for (const auto& from : of_observation.laser_corrections) {
        sensors::VelodyneLaser& laser = calibration.lasers.emplace_back();
        laser.azimuth_deg = from.azimuthCorrection;
        laser.elevation_deg = from.verticalCorrection;
        laser.elevation_sine = from.sinVertCorrection;
        laser.elevation_cosine = from.cosVertCorrection;
        laser.distance_m = from.distanceCorrection;
        laser.horizontal_offset_m = from.horizontalOffsetCorrection;
        laser.vertical_offset_m = from.verticalOffsetCorrection;
        // Checks these unused products, because a calibration in which they are not finite is
        // corrupt.
        if (!std::isfinite(from.sinVertOffsetCorrection + from.cosVertOffsetCorrection)) {
            laser.vertical_offset_m = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

mrpt::obs::VelodyneCalibration mrptCalibration(const sensors::VelodyneCalibration& calibration) {
    mrpt::obs::VelodyneCalibration converted;
    for (const sensors::VelodyneLaser& from : calibration.lasers) {
        auto& laser = converted.laser_corrections.emplace_back();
        laser.azimuthCorrection = from.azimuth_deg;
        laser.verticalCorrection = from.elevation_deg;
        laser.sinVertCorrection = from.elevation_sine;
        laser.cosVertCorrection = from.elevation_cosine;
        laser.distanceCorrection = from.distance_m;
        laser.verticalOffsetCorrection = from.vertical_offset_m;
        laser.horizontalOffsetCorrection = from.horizontal_offset_m;
        laser.sinVertOffsetCorrection = from.vertical_offset_m * from.elevation_sine;
        // Without an offset, MRPT writes a zero with the sign of the sine.
        laser.cosVertOffsetCorrection = from.vertical_offset_m == 0
                                            ? laser.sinVertOffsetCorrection
                                            : from.vertical_offset_m * from.elevation_cosine;
    }
    return converted;
}

void sensorOf(const CObservationVelodyneScan& observation, SensorModel& sensor,
              ObservationWorkspace& work) {
    readCalibration(observation.calibration, work.calibration);
    beamsOf(packetsOf(observation), work.calibration, sensor);
    const bool are_sound = observation.minRange >= 0 &&
                           observation.minRange < observation.maxRange &&
                           std::isfinite(static_cast<float>(observation.maxRange));
    if (!are_sound) throw std::runtime_error("invalid range limits");
    sensor.min_range_m = static_cast<float>(observation.minRange);
    sensor.max_range_m = static_cast<float>(observation.maxRange);
}

SensorModel sensorOf(const CObservationVelodyneScan& observation) {
    SensorModel sensor;
    ObservationWorkspace work;
    sensorOf(observation, sensor, work);
    return sensor;
}

std::size_t decodePackets(const CObservationVelodyneScan& observation, Scan& scan,
                          ObservationWorkspace& work) {
    readCalibration(observation.calibration, work.calibration);
    return decodePackets(packetsOf(observation), work.calibration, scan, work.packets);
}

std::size_t decodePackets(const CObservationVelodyneScan& observation, Scan& scan) {
    ObservationWorkspace work;
    return decodePackets(observation, scan, work);
}

void forEachPacket(const mrpt::obs::CObservation& observation,
                   const std::function<void(const sensors::Datagram&)>& take) {
    const auto* const scan = dynamic_cast<const CObservationVelodyneScan*>(&observation);
    if (scan == nullptr) return;
    sensors::Datagram datagram;
    datagram.from_port = datagram.to_port = 2368;
    datagram.size = sensors::kVelodynePacketBytes;
    const auto start_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
        observation.timestamp - mrpt::Clock::fromDouble(0));
    double first_us = 0;
    for (const auto& raw : scan->scan_packets) {
        sensors::VelodynePacket packet;
        std::memcpy(packet.bytes.data(), &raw, packet.bytes.size());
        const double time_us = packet.sensorTimeUs();
        if (&raw == scan->scan_packets.data()) first_us = time_us;
        datagram.time_ns =
            start_ns.count() + std::llround(1e3 * sensors::elapsedUs(first_us, time_us));
        datagram.bytes = packet.bytes.data();
        take(datagram);
    }
}

}  // namespace hagen::observations
