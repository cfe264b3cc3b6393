#pragma once
#include <hagen/sensors/VelodyneModel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hagen::sensors {

/// The layout of a data packet: blocks of a header, an azimuth and 32 returns of three bytes, then
/// a time of four bytes, the mode and the model. All numbers are little-endian.
constexpr std::size_t kVelodynePacketBytes = 1206;
constexpr int kVelodyneBlocks = 12;
constexpr std::size_t kPositionBytes = 512;                         ///< of a position packet (GPS)
constexpr int kVelodyneBlockBytes = 100, kVelodyneHeaderBytes = 4;  ///< header and azimuth
constexpr std::size_t kReturnsOfBlock = 32;
constexpr unsigned kUpperBlock = 0xeeff, kLowerBlock = 0xddff;  ///< headers
constexpr int kReadingsOfTurn = 36000;                          ///< azimuths are in 0.01 degrees
constexpr std::size_t kVelodyneTimeAt = 1200, kVelodyneModeAt = 1204, kVelodyneModelAt = 1205;
constexpr std::uint8_t kStrongestReturn = 0x37, kDualReturn = 0x39;  ///< modes

/// A data packet of a Velodyne and when it came.
struct VelodynePacket {
    std::array<std::uint8_t, kVelodynePacketBytes> bytes;
    std::int64_t time_ns = 0;  ///< since 1970

    /// Microseconds since the full hour, by the sensor's clock.
    double sensorTimeUs() const;
    /// Whether it says so; those of an HDL-64E do not.
    bool isDual() const;
    /// Azimuth of a block, 0.01 degrees; -1: it has none.
    int azimuthOf(int block) const;
    /// That of the first block that has one, without those of lower lasers; -1: none has.
    int azimuth() const;
};

/// Whether these bytes are a data packet: of the right size, and any of its blocks has a header.
bool isVelodyneData(const std::uint8_t* bytes, std::size_t size);
/// Whether such a packet is of an HDL-64E, the only one to send blocks of lower lasers.
bool isOfHdl64(const std::uint8_t* packet);
/// The model that sent such a packet; null: unknown.
const VelodyneModel* velodyneModelOf(const std::uint8_t* packet);

/// From one time of a sensor's clock to another: within half an hour, as it wraps every hour.
inline double elapsedUs(double from_us, double to_us) {
    constexpr double kHourUs = 3600e6;
    return std::remainder(to_us - from_us, kHourUs);
}

}  // namespace hagen::sensors
