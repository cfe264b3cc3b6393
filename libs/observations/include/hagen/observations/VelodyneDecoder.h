#pragma once
#include <hagen/observations/VelodyneBlock.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstddef>
#include <vector>

namespace hagen::observations {

/// Returns the sensor that took these packets: its calibration's beams (those of the model's
/// default calibration if the observation has none) and the observation's range limits. Throws
/// std::runtime_error for an unknown model, and for an HDL-64E without calibration.
SensorModel sensorOf(const mrpt::obs::CObservationVelodyneScan& observation);
/// The same, into `sensor`, whose memory is reused.
void sensorOf(const mrpt::obs::CObservationVelodyneScan& observation, SensorModel& sensor);

/// Buffers of decodePackets(). Reuse them across scans to avoid allocation; no state carries over.
struct DecoderWorkspace {
    std::vector<VelodyneBlock> blocks;  ///< the valid blocks of the scan
    std::vector<int> turns;             ///< from block to block, in 0.01 degrees
};

/// Decodes all raw packets of an observation: every return with a range above zero, in the order of
/// the packets, regardless of the observation's range limits. (MRPT's own generatePointCloud()
/// decodes half of each block.) Supports strongest, last and dual mode; in dual mode, both returns
/// of a firing are decoded even if they are equal.
///
/// Azimuths are interpolated within a block; times are those of the firings, relative to the first
/// packet's time stamp. There is no trigonometry per return.
///
/// Packets of an HDL-64E need the observation's calibration, of 64 lasers. Its offsets are
/// perpendicular to the beam, as in the sensor's manual; all lasers of a firing have the azimuth of
/// their block, but for their own correction. Corrections for close distances (distCorrectionX and
/// Y) and of intensities are not applied: MRPT's calibration has none.
///
/// Returns the number of skipped blocks, which have a wrong header (not 0xEEFF, of an
/// HDL-64E nor 0xDDFF) or an invalid azimuth. Throws std::runtime_error for a packet of an unknown
/// model or of another model than the first packet; the message names the packet, and `scan` is
/// unchanged. Reuses the memory of `scan`.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan,
                          DecoderWorkspace& work);
/// The same for single scans: allocates its own buffers.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::observations
