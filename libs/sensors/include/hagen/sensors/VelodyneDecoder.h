#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/VelodyneBlock.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodynePacket.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::sensors {

/// Data packets of a scan, each of kVelodynePacketBytes, one after the other in memory.
struct VelodynePackets {
    const std::uint8_t* bytes = nullptr;
    std::size_t count = 0;

    const std::uint8_t* at(std::size_t packet) const {
        return bytes + packet * kVelodynePacketBytes;
    }
};

/// Puts the name of the sensor that took these packets and its beams into `sensor`, whose memory is
/// reused: those of `calibration` if it has the model's number of lasers, otherwise those of the
/// model's default calibration. Throws std::runtime_error for an unknown model, and for an HDL-64E
/// without calibration.
void beamsOf(const VelodynePackets& packets, const VelodyneCalibration& calibration,
             SensorModel& sensor);

/// Buffers of decodePackets(). Reuse them across scans to avoid allocation; no state carries over.
struct DecoderWorkspace {
    std::vector<VelodyneBlock> blocks;  ///< the valid blocks of the scan
    std::vector<int> turns;             ///< from block to block, in 0.01 degrees
};

/// Decodes all packets of a scan: every return with a range above zero, in the order of the
/// packets. Supports strongest, last and dual mode; in dual mode, both returns of a firing are
/// decoded even if they are equal. The calibration is the one that beamsOf() takes.
///
/// Azimuths are interpolated within a block; times are those of the firings, relative to the first
/// packet's time stamp. There is no trigonometry per return.
///
/// Packets of an HDL-64E need a calibration of 64 lasers. Its offsets are perpendicular to the
/// beam, as in the sensor's manual; all lasers of a firing have the azimuth of their block, but for
/// their own correction. Corrections for close distances (distCorrectionX and Y) and of intensities
/// are not applied.
///
/// Returns the number of skipped blocks, which have a wrong header (not 0xEEFF, of an
/// HDL-64E nor 0xDDFF) or an invalid azimuth. Throws std::runtime_error for a packet of an unknown
/// model or of another model than the first packet; the message names the packet, and `scan` is
/// unchanged. Reuses the memory of `scan`.
std::size_t decodePackets(const VelodynePackets& packets, const VelodyneCalibration& own,
                          Scan& scan, DecoderWorkspace& work);

}  // namespace hagen::sensors
