#pragma once
// Conversions between CObservationVelodyneScan and the decoder of libs/sensors.
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/VelodyneCalibration.h>
#include <cstddef>
#include <functional>

namespace hagen::observations {

/// Converts an observation's calibration, without checks, and reuses the memory of `calibration`.
void readCalibration(const mrpt::obs::VelodyneCalibration& of_observation,
                     sensors::VelodyneCalibration& calibration);
/// The inverse of readCalibration().
mrpt::obs::VelodyneCalibration mrptCalibration(const sensors::VelodyneCalibration& calibration);

/// Buffers of decodePackets() and sensorOf(). Reuse them across scans to avoid allocation; they
/// have no state.
struct ObservationWorkspace {
    sensors::DecoderWorkspace packets;
    sensors::VelodyneCalibration calibration;  ///< calibration of the observation
};

/// Returns the sensor of these packets: the beams of the calibration (default: the model's) and the
/// observation's range limits. Throws std::runtime_error for an unknown model, and for an HDL-64E
/// without calibration.
SensorModel sensorOf(const mrpt::obs::CObservationVelodyneScan& observation);
/// Like above, but writes to `sensor` and reuses its memory.
void sensorOf(const mrpt::obs::CObservationVelodyneScan& observation, SensorModel& sensor,
              ObservationWorkspace& work);

/// Decodes all raw packets of an observation with its calibration (sensors::decodePackets()),
/// regardless of its range limits. (MRPT's generatePointCloud() decodes only half of each block.)
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan,
                          ObservationWorkspace& work);
/// Like above, with temporary buffers.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

/// Calls `take` with each packet of a CObservationVelodyneScan as a datagram to port 2368, timed by
/// the observation and the clock of the sensor. Other observations have no packets.
void forEachPacket(const mrpt::obs::CObservation& observation,
                   const std::function<void(const sensors::Datagram&)>& take);

}  // namespace hagen::observations
