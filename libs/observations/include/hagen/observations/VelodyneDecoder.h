#pragma once
#include <hagen/observations/VelodyneBlock.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <cstddef>
#include <vector>

namespace hagen::observations {

/// The sensor that took these packets: its calibration's beams (those of the model's default
/// calibration if the observation has none) and the observation's range limits. Throws
/// std::runtime_error for a model that is neither VLP-16 nor HDL-32E.
SensorModel sensorOf(const mrpt::obs::CObservationVelodyneScan& observation);
/// The same, into `sensor`, whose memory is reused.
void sensorOf(const mrpt::obs::CObservationVelodyneScan& observation, SensorModel& sensor);

/// The memory of decodePackets(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over.
struct DecoderWorkspace {
    std::vector<VelodyneBlock> blocks;  ///< the sound blocks of the scan
    std::vector<int> turns;             ///< from block to block, in 0.01 degrees
};

/// Decodes all raw packets of an observation: every return with a range above zero, in the order of
/// the packets, whatever the observation's range limits. (MRPT's own generatePointCloud() decodes
/// half of each block.) Supports strongest, last and dual mode; in dual mode, both returns of a
/// firing are decoded even if they are equal.
///
/// Azimuths are interpolated within a block; times are those of the firings, counted from the first
/// packet's time stamp. There is no trigonometry per return.
///
/// Returns the number of blocks left out because their header is not that of a block (0xEEFF) or
/// their azimuth is not an angle. Throws std::runtime_error, naming the packet, for one of an
/// unknown model or of a model other than the first packet's; `scan` is then unchanged. Reuses the
/// memory of `scan`.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan,
                          DecoderWorkspace& work);
/// The same for single scans: allocates its own workspace.
std::size_t decodePackets(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::observations
