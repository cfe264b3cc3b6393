#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hagen::sensors {

/// The firing sequence of a Velodyne, from its manual; used by the packet decoder and encoder. A
/// packet has 12 blocks of 32 returns, ordered by firing, laser and return. Firings of more than 32
/// lasers have several blocks, one per bank of 32.
struct VelodyneModel {
    std::string name;         ///< name in settings: "VLP-16"
    std::uint8_t id;          ///< product id in the packet's last byte
    int lasers;               ///< number of lasers in a firing
    int firings_per_block;    ///< lasers * firings_per_block = 32, or 1 for several banks
    int lasers_at_once;       ///< number of simultaneous lasers, adjacent in the packet
    double laser_period_us;   ///< between lasers (or simultaneous groups) of a firing
    double firing_period_us;  ///< between firings
    float distance_unit_m;    ///< unit of distances in packets

    int banks() const { return lasers > 32 ? lasers / 32 : 1; }
    /// Number of blocks with the same azimuth: all banks and returns.
    int blocksAtOnce(bool is_dual) const { return banks() * (is_dual ? 2 : 1); }
    /// Number of blocks with data. Firings do not span packets, so a VLS-128 in dual mode uses 8.
    int usedBlocks(bool is_dual) const { return 12 - 12 % blocksAtOnce(is_dual); }
    /// Time between blocks of different azimuths.
    double blockPeriodUs() const { return firings_per_block * firing_period_us; }
    /// Time between packets.
    double packetPeriodUs(bool is_dual) const {
        const int azimuths = usedBlocks(is_dual) / blocksAtOnce(is_dual);
        return azimuths * blockPeriodUs();
    }
    /// Time from a firing's first laser to this laser. A VLS-128 pauses after 64 lasers.
    double delayUs(int laser) const {
        const int group = laser / lasers_at_once + laser / 64;
        return group * laser_period_us;
    }
    /// A laser's rotation relative to its block: 0 at the block's azimuth, 1 at the next block's.
    double turnWithinBlock(int firing, int laser) const {
        return (firing * firing_period_us + delayUs(laser)) / blockPeriodUs();
    }
};

/// All models except the HDL-64E.
const std::vector<VelodyneModel>& velodyneModels();
/// Returns the model with this product ID, or nullptr: VLP-16 0x22, Puck Hi-Res 0x24, HDL-32E 0x21,
/// VLP-32C 0x28, VLS-128 0xa1.
const VelodyneModel* findVelodyneModel(std::uint8_t id);
/// The HDL-64E S2 and S3. Their packets have no ID: blocks of the upper 32 lasers (0xEEFF)
/// alternate with blocks of the lower 32 (0xDDFF), two blocks per firing. Their beams come from a
/// calibration (readVelodyneCalibration()), so velodyneModels() does not include them.
const VelodyneModel& hdl64Model();
/// Returns the model with this name. Throws std::invalid_argument if the name is unknown.
const VelodyneModel& velodyneModel(std::string_view name);

/// Such as "an unsupported sensor (Velarray, model id 0x31)", for other product IDs.
std::string describeUnsupported(unsigned id);

/// The names and IDs of all models: " VLP-16 (0x22), ...".
std::string knownVelodynes();

/// Converts a packet's azimuth reading (0.01 degrees, fractions allowed) to degrees clockwise from
/// x, within +-180. Matches MRPT's decoder, which spreads the 36000 readings over a full revolution
/// including both ends and is therefore up to 0.01 degrees ahead.
double azimuthOfReadingDeg(double reading);

}  // namespace hagen::sensors
