// Livox datagrams with arbitrary content.
#include <hagen/scan/SensorModel.h>

#include "fuzz/Target.h"
#include "sensors/livox/LivoxPacket.h"

namespace hagen::fuzz {
namespace {

void decode(std::string_view input) {
    sensors::Datagram datagram;
    datagram.bytes = reinterpret_cast<const std::uint8_t*>(input.data());
    datagram.size = input.size();
    sensors::isLivoxImu(datagram);
    const auto packet = sensors::livoxPacketOf(datagram);
    if (!packet) return;
    require(packet->count * packet->point_bytes <= input.size(), "more points than bytes");
    Scan scan;
    std::vector<std::uint8_t> tags;
    appendPoints(*packet, 0, scan, tags);
    appendPoints(*packet, packet->time_ns + 1, scan, tags);
    require(tags.size() == scan.size() && scan.time_s.size() == scan.size(), "sizes differ");
    locateBeams(sensorModel("Mid-360"), scan);
}

/// A packet in the manufacturer's protocol: a header of 36 bytes, then points.
std::string packetOf(std::uint8_t type, std::size_t point_bytes, std::uint16_t points) {
    std::string bytes(36, '\0');
    const auto put = [&](std::size_t at, auto number) {
        std::memcpy(&bytes[at], &number, sizeof number);
    };
    put(1, static_cast<std::uint16_t>(36 + point_bytes * points));
    put(3, std::uint16_t{1000});
    put(5, points);
    put(10, type);
    put(28, std::uint64_t{1000000000});
    for (std::size_t i = 0; i < point_bytes * points; ++i) bytes += static_cast<char>(7 * i);
    return bytes;
}

Seeds packetSeeds() { return {packetOf(1, 14, 96), packetOf(2, 8, 96), packetOf(0, 24, 1)}; }

const bool kAdded = add({"livox_packets", decode, packetSeeds, {}, 1500});

}  // namespace
}  // namespace hagen::fuzz
