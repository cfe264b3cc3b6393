#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/sensors/CaptureFile.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::sensors {

/// The header of a point packet of Livox SDK 2.
struct LivoxPacket {
    const std::uint8_t* points = nullptr;
    std::size_t count = 0;
    std::size_t point_bytes = 0;  ///< 14: millimetres; 8: centimetres
    double point_interval_s = 0;  ///< from one point to the next
    std::uint16_t number = 0;     ///< sequence number, wraps
    std::uint64_t time_ns = 0;    ///< sensor time of the first point
};

/// Parses a packet with Cartesian points; nullopt for other datagrams.
std::optional<LivoxPacket> livoxPacketOf(const Datagram& datagram);

/// True if a datagram is an IMU packet (rates and accelerations).
bool isLivoxImu(const Datagram& datagram);

/// Appends the points of a packet with times since `start_ns` and tags (confidence). Skips points
/// at the origin, which have no range. Does not locate beams.
void appendPoints(const LivoxPacket& packet, std::uint64_t start_ns, Scan& scan,
                  std::vector<std::uint8_t>& tags);

}  // namespace hagen::sensors
