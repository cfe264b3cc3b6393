#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstddef>

namespace hagen::observations {

/// Buffers of decodePackets() and sensorOf(). Reuse them across scans to avoid allocation; no state
/// carries over.
struct DecoderWorkspace {
    sensors::DecoderWorkspace packets;
    sensors::VelodyneCalibration calibration;  ///< that of the observation
};

/// Returns the sensor that took these packets: its calibration's beams (those of the model's
/// default calibration if the observation has none) and the observation's range limits. Throws
/// std::runtime_error for an unknown model, and for an HDL-64E without calibration.
SensorModel sensorOf(const mrpt::obs::CObservationVelodyneScan& observation);
/// The same, into `sensor`, whose memory is reused.
void sensorOf(const mrpt::obs::CObservationVelodyneScan& observation, SensorModel& sensor,
              DecoderWorkspace& work);

/// Decodes all raw packets of an observation (sensors::decodePackets()), regardless of its range
/// limits, with its calibration. (MRPT's own generatePointCloud() decodes half of each block.)
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan,
                          DecoderWorkspace& work);
/// The same for single scans: allocates its own buffers.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::observations
