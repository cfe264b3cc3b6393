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

/// The data packets of a scan, kVelodynePacketBytes each, contiguous in memory.
struct VelodynePackets {
    const std::uint8_t* bytes = nullptr;
    std::size_t count = 0;

    const std::uint8_t* at(std::size_t packet) const {
        return bytes + packet * kVelodynePacketBytes;
    }
};

/// Sets `sensor` to the sensor of these packets, reusing its memory. Uses the beams of
/// `calibration` if it has the model's number of lasers, otherwise those of the default
/// calibration. Throws std::runtime_error for an unknown model, and for an HDL-64E without
/// calibration.
void beamsOf(const VelodynePackets& packets, const VelodyneCalibration& calibration,
             SensorModel& sensor);

/// Buffers of decodePackets(). Stateless; reuse them between scans to avoid allocations.
struct DecoderWorkspace {
    std::vector<VelodyneBlock> blocks;  ///< valid blocks of the scan
    std::vector<int> turns;             ///< rotation between blocks, in 0.01 degrees
};

/// Decodes all packets of a scan: every return with a range above zero, in packet order. Supports
/// strongest, last and dual mode; in dual mode, decodes both returns of a firing even if they are
/// equal. Chooses the calibration like beamsOf().
///
/// Azimuths are interpolated within a block; times are firing times relative to the first packet's
/// timestamp. There is no trigonometry per return.
///
/// HDL-64E packets require a calibration with 64 lasers. Its offsets are perpendicular to the beam,
/// as in the sensor's manual; all lasers of a firing have their block's azimuth plus their own
/// correction. Close-range corrections (distCorrectionX and Y) and intensity corrections are not
/// applied.
///
/// `turn_between_packets`: rotation in 0.01 degrees, for a single packet with one firing (VLS-128
/// in dual mode).
///
/// Returns the number of skipped blocks: those with an invalid azimuth or the header of a bank that
/// the model lacks. If a packet is from an unknown model, or from another
/// model than the first packet, throws std::runtime_error naming the packet and leaves `scan`
/// unchanged. Reuses the memory of `scan`.
std::size_t decodePackets(const VelodynePackets& packets, const VelodyneCalibration& own,
                          Scan& scan, DecoderWorkspace& work, int turn_between_packets = 0);

}  // namespace hagen::sensors
