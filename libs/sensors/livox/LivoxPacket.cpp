#include "sensors/livox/LivoxPacket.h"

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

constexpr std::size_t kHeader = 36;
constexpr int kMillimetres = 1, kCentimetres = 2;  // data types

/// Reads a signed coordinate of 2 or 4 bytes.
float coordinate(const std::uint8_t* at, bool is_fine, float unit_m) {
    const std::int32_t number = is_fine ? static_cast<std::int32_t>(little<std::uint32_t>(at))
                                        : static_cast<std::int16_t>(little<std::uint16_t>(at));
    return static_cast<float>(number) * unit_m;
}

}  // namespace

std::optional<LivoxPacket> livoxPacketOf(const Datagram& datagram) {
    const std::uint8_t* const bytes = datagram.bytes;
    if (datagram.size <= kHeader || bytes[0] != 0 ||
        little<std::uint16_t>(bytes + 1) != datagram.size) {
        return std::nullopt;
    }
    LivoxPacket packet;
    if (bytes[10] == kMillimetres) packet.point_bytes = 14;
    if (bytes[10] == kCentimetres) packet.point_bytes = 8;
    packet.count = little<std::uint16_t>(bytes + 5);
    const bool fits = packet.point_bytes > 0 && packet.count > 0 &&
                      kHeader + packet.count * packet.point_bytes == datagram.size;
    if (!fits) return std::nullopt;
    // The header contains the interval of the whole packet, in 0.1 us.
    packet.point_interval_s = 1e-7 * static_cast<double>(little<std::uint16_t>(bytes + 3)) /
                              static_cast<double>(packet.count);
    packet.number = little<std::uint16_t>(bytes + 7);
    packet.time_ns = little<std::uint64_t>(bytes + 28);
    packet.points = bytes + kHeader;
    return packet;
}

bool isLivoxImu(const Datagram& datagram) {
    constexpr std::size_t kSize = kHeader + 24;  // angular rates and accelerations, float32
    constexpr int kImu = 0;
    const std::uint8_t* const bytes = datagram.bytes;
    return datagram.size == kSize && bytes[0] == 0 && little<std::uint16_t>(bytes + 1) == kSize &&
           bytes[10] == kImu;
}

void appendPoints(const LivoxPacket& packet, std::uint64_t start_ns, Scan& scan,
                  std::vector<std::uint8_t>& tags) {
    const bool is_fine = packet.point_bytes == 14;
    const int bytes = is_fine ? 4 : 2;
    const float unit_m = is_fine ? 0.001f : 0.01f;
    const auto since_ns = static_cast<std::int64_t>(packet.time_ns - start_ns);
    for (std::size_t i = 0; i < packet.count; ++i) {
        const std::uint8_t* const at = packet.points + i * packet.point_bytes;
        const float x_m = coordinate(at, is_fine, unit_m);
        const float y_m = coordinate(at + bytes, is_fine, unit_m);
        const float z_m = coordinate(at + 2 * bytes, is_fine, unit_m);
        if (x_m == 0 && y_m == 0 && z_m == 0) continue;
        scan.x_m.push_back(x_m);
        scan.y_m.push_back(y_m);
        scan.z_m.push_back(z_m);
        scan.intensity.push_back(static_cast<float>(at[3 * bytes]) / 255.0f);
        tags.push_back(at[3 * bytes + 1]);
        scan.time_s.push_back(static_cast<float>(1e-9 * static_cast<double>(since_ns) +
                                                 static_cast<double>(i) * packet.point_interval_s));
    }
}

}  // namespace hagen::sensors
