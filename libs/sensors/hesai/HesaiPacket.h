#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/sensors/Datagram.h>

#include <cstdint>
#include <optional>

namespace hagen::sensors {

/// A data packet of a Hesai XT32 or XT16: eight blocks of one azimuth, with one return per channel.
struct HesaiPacket {
    const char* model;      ///< name in settings
    int channels;           ///< highest beam first
    int returns;            ///< per firing: 2 adjacent blocks in dual mode
    std::uint16_t number;   ///< UDP sequence number (wraps)
    std::uint64_t time_ns;  ///< sensor time
    const std::uint8_t* blocks;

    int firings() const { return 8 / returns; }
    double period_s() const { return 50e-6 * firings(); }
    /// Azimuth of a firing in 0.01 degrees, clockwise from x.
    int azimuthOf(int firing) const;
    /// Rotation from one firing to the next in 0.01 degrees; -1 if azimuths are invalid.
    double step() const;
};

/// Parses a data packet; returns nullopt for other datagrams.
std::optional<HesaiPacket> hesaiPacketOf(const Datagram& datagram);

/// Appends the returns of a packet, with times since `start_ns`. Uses the directions of the manual:
/// all channels have their block's azimuth. The angle correction of the individual sensor is not in
/// its packets; it deviates by up to 0.15 degrees.
void appendReturns(const HesaiPacket& packet, const SensorModel& sensor, std::uint64_t start_ns,
                   Scan& scan);

}  // namespace hagen::sensors
