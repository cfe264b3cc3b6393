#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/sensors/CaptureFile.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::sensors {

/// The header of a Livox SDK 2 point packet.
struct LivoxPacket {
    const std::uint8_t* points = nullptr;
    std::size_t count = 0;
    std::size_t point_bytes = 0;  ///< 14 if in millimetres, 8 if in centimetres
    double point_interval_s = 0;  ///< time between points
    std::uint16_t number = 0;     ///< sequence number (wraps)
    std::uint64_t time_ns = 0;    ///< sensor time of the first point
};

/// Parses a packet with Cartesian points; returns nullopt for other datagrams.
std::optional<LivoxPacket> livoxPacketOf(const Datagram& datagram);

/// True if the datagram is an IMU packet (angular rates and accelerations).
bool isLivoxImu(const Datagram& datagram);

/// Appends the points of a packet with tags (confidence) and times since `start_ns`. Skips points
/// at the origin, which have no range. Does not locate beams.
void appendPoints(const LivoxPacket& packet, std::uint64_t start_ns, Scan& scan,
                  std::vector<std::uint8_t>& tags);

}  // namespace hagen::sensors
