#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::sensors {

/// The firing sequence of a Velodyne sensor, from its manual; shared by the packet decoder and
/// encoder. A packet contains 12 blocks of 32 returns, ordered by firing and laser.
struct VelodyneModel {
    std::string name;         ///< name in settings: "VLP-16"
    std::uint8_t id;          ///< product id in the packet's last byte
    int lasers;               ///< returns of one firing
    int firings_per_block;    ///< lasers * firings_per_block = 32
    int lasers_at_once;       ///< number of lasers that fire at once, adjacent in the packet
    double laser_period_us;   ///< from one laser (or group of lasers) of a firing to the next
    double firing_period_us;  ///< from one firing to the next
    float distance_unit_m;    ///< unit of distances in packets

    double blockPeriodUs() const { return firings_per_block * firing_period_us; }
    /// Time from one packet to the next.
    double packetPeriodUs(bool is_dual) const { return (is_dual ? 6 : 12) * blockPeriodUs(); }
    /// Time from a firing's first laser to this laser.
    double delayUs(int laser) const {
        const int group = laser / lasers_at_once;
        return group * laser_period_us;
    }
    /// A laser's position within its block's rotation: 0 at the block's azimuth, 1 at the next
    /// block's.
    double turnWithinBlock(int firing, int laser) const {
        return (firing * firing_period_us + delayUs(laser)) / blockPeriodUs();
    }
};

/// All models except the HDL-64E.
const std::vector<VelodyneModel>& velodyneModels();
/// Returns the model with this product id, or nullptr: VLP-16 0x22, Puck Hi-Res 0x24, HDL-32E 0x21,
/// VLP-32C 0x28.
const VelodyneModel* findVelodyneModel(std::uint8_t id);
/// The HDL-64E S2 and S3, whose packets have no id: blocks of its upper 32 lasers (0xEEFF)
/// alternate with blocks of the lower 32 (0xDDFF), two blocks to a firing. Its beams come from a
/// calibration (readVelodyneCalibration()); velodyneModels() does not include it.
const VelodyneModel& hdl64Model();
/// Returns the model with this name. Throws std::invalid_argument for any other name.
const VelodyneModel& velodyneModel(const std::string& name);

/// The names and ids of all models: " VLP-16 (0x22), ...".
std::string knownVelodynes();

/// Converts a packet's azimuth reading (0.01 degrees, fractions allowed) to degrees clockwise from
/// x, within +-180. Matches MRPT's own decoder, so that both clouds coincide: MRPT spreads the
/// 36000 readings over a full revolution with both ends inclusive, and is therefore up to 0.01
/// degrees ahead.
double azimuthOfReadingDeg(double reading);

}  // namespace hagen::sensors
