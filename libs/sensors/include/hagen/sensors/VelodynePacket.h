#pragma once
#include <hagen/sensors/VelodyneModel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hagen::sensors {

/// Layout of a data packet: blocks with a header, an azimuth and 32 returns of three bytes,
/// followed by a four-byte time, the mode and the model. All numbers are little-endian.
constexpr std::size_t kVelodynePacketBytes = 1206;
constexpr int kVelodyneBlocks = 12;
constexpr std::size_t kPositionBytes = 512;  ///< size of a position packet (GPS)
constexpr int kVelodyneBlockBytes = 100, kVelodyneHeaderBytes = 4;  ///< header and azimuth
constexpr std::size_t kReturnsOfBlock = 32;
constexpr unsigned kBankHeaders[] = {0xeeff, 0xddff, 0xccff, 0xbbff};  ///< 32 lasers each
constexpr int kReadingsOfTurn = 36000;  ///< azimuths are in 0.01 degrees
constexpr std::size_t kVelodyneTimeAt = 1200, kVelodyneModeAt = 1204, kVelodyneModelAt = 1205;
constexpr std::uint8_t kStrongestReturn = 0x37, kDualReturn = 0x39;  ///< modes

/// A Velodyne data packet and its arrival time.
struct VelodynePacket {
    std::array<std::uint8_t, kVelodynePacketBytes> bytes;
    std::int64_t time_ns = 0;  ///< since 1970

    /// Microseconds since the full hour on the sensor's clock.
    double sensorTimeUs() const;
    /// True if the packet is marked as dual. HDL-64E packets have no mark.
    bool isDual() const;
    /// Azimuth of a block in 0.01 degrees; -1 if invalid.
    int azimuthOf(int block) const;
    /// Azimuth of the first valid block of the first bank; -1 if there is none.
    int azimuth() const;
};

/// The bank of a block's lasers; -1 if its header is invalid.
int bankOf(const std::uint8_t* packet, int block);
/// True for a data packet, which has the right size and at least one block with a header.
bool isVelodyneData(const std::uint8_t* bytes, std::size_t size);
/// True if the packet is from an HDL-64E, the only model with two banks.
bool isOfHdl64(const std::uint8_t* packet);
/// The model of a packet's sensor; null if unknown.
const VelodyneModel* velodyneModelOf(const std::uint8_t* packet);

/// Time between two readings of a sensor clock, within +-30 min because the clock wraps every hour.
inline double elapsedUs(double from_us, double to_us) {
    constexpr double kHourUs = 3600e6;
    return std::remainder(to_us - from_us, kHourUs);
}

}  // namespace hagen::sensors
