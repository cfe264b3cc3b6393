#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstddef>

namespace hagen::observations {

/// The sensor that took these packets: its calibration's beams (the model's default calibration
/// where the observation has none) and the observation's range limits. Throws std::runtime_error
/// for a model that is neither VLP-16 nor HDL-32E.
SensorModel sensorOf(const mrpt::obs::CObservationVelodyneScan& observation);
/// The same, into `sensor`, whose memory is used again.
void sensorOf(const mrpt::obs::CObservationVelodyneScan& observation, SensorModel& sensor);

/// Decodes all raw packets of an observation: every return with a range above zero, in the order of
/// the packets, whatever the observation's range limits. (MRPT's own generatePointCloud() decodes
/// half of each block.) Strongest, last and dual mode; in dual mode both returns of a firing come
/// out, also where they are equal.
///
/// Azimuths are interpolated within a block; times are those of the firings, from the first
/// packet's time stamp on. No trigonometry a return.
///
/// Returns the number of blocks left out because their header is not a block's (0xEEFF) or their
/// azimuth is no angle. Throws std::runtime_error, naming the packet, for one of an unknown model
/// or of another model than the first packet's, and then leaves `scan` as it was. The memory of
/// `scan` is used again.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::observations
