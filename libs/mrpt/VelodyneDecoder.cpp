#include <hagen/mrpt/VelodyneCalibrations.h>
#include <hagen/mrpt/VelodyneDecoder.h>

#include <cmath>
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

void sensorOf(const CObservationVelodyneScan& observation, SensorModel& sensor,
              DecoderWorkspace& work) {
    readCalibration(observation.calibration, work.calibration);
    beamsOf(packetsOf(observation), work.calibration, sensor);
    const bool are_sound = observation.minRange >= 0 &&
                           observation.minRange < observation.maxRange &&
                           std::isfinite(static_cast<float>(observation.maxRange));
    if (!are_sound) throw std::runtime_error("its limits of the range contradict each other");
    sensor.min_range_m = static_cast<float>(observation.minRange);
    sensor.max_range_m = static_cast<float>(observation.maxRange);
}

SensorModel sensorOf(const CObservationVelodyneScan& observation) {
    SensorModel sensor;
    DecoderWorkspace work;
    sensorOf(observation, sensor, work);
    return sensor;
}

std::size_t decodePackets(const CObservationVelodyneScan& observation, Scan& scan,
                          DecoderWorkspace& work) {
    readCalibration(observation.calibration, work.calibration);
    return decodePackets(packetsOf(observation), work.calibration, scan, work.packets);
}

std::size_t decodePackets(const CObservationVelodyneScan& observation, Scan& scan) {
    DecoderWorkspace work;
    return decodePackets(observation, scan, work);
}

}  // namespace hagen::observations
