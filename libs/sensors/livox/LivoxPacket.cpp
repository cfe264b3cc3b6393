#include <hagen/sensors/LivoxPacket.h>

namespace hagen::sensors {
namespace {

constexpr std::size_t kHeader = 36;
constexpr int kMillimetres = 1, kCentimetres = 2;  // kinds of data

std::uint64_t little(const std::uint8_t* at, int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint64_t{at[i]} << (8 * i);
    return value;
}

/// A signed coordinate of 2 or 4 bytes.
float coordinate(const std::uint8_t* at, int bytes, float unit_m) {
    const std::uint64_t value = little(at, bytes);
    const auto number = bytes == 2 ? static_cast<std::int16_t>(value)
                                   : static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
    return static_cast<float>(number) * unit_m;
}

}  // namespace

std::optional<LivoxPacket> livoxPacketOf(const Datagram& datagram) {
    const std::uint8_t* const bytes = datagram.bytes;
    if (datagram.size <= kHeader || bytes[0] != 0 || little(bytes + 1, 2) != datagram.size) {
        return std::nullopt;
    }
    LivoxPacket packet;
    if (bytes[10] == kMillimetres) packet.point_bytes = 14;
    if (bytes[10] == kCentimetres) packet.point_bytes = 8;
    packet.count = little(bytes + 5, 2);
    const bool fits = packet.point_bytes > 0 && packet.count > 0 &&
                      kHeader + packet.count * packet.point_bytes == datagram.size;
    if (!fits) return std::nullopt;
    // The interval in the header is that of the whole packet, in 0.1 us.
    packet.point_interval_s =
        1e-7 * static_cast<double>(little(bytes + 3, 2)) / static_cast<double>(packet.count);
    packet.number = static_cast<std::uint16_t>(little(bytes + 7, 2));
    packet.time_ns = little(bytes + 28, 8);
    packet.points = bytes + kHeader;
    return packet;
}

bool isLivoxImu(const Datagram& datagram) {
    constexpr std::size_t kSize = kHeader + 24;  // three rates, three accelerations, as float32
    constexpr int kImu = 0;
    const std::uint8_t* const bytes = datagram.bytes;
    return datagram.size == kSize && bytes[0] == 0 && little(bytes + 1, 2) == kSize &&
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
        const float x_m = coordinate(at, bytes, unit_m);
        const float y_m = coordinate(at + bytes, bytes, unit_m);
        const float z_m = coordinate(at + 2 * bytes, bytes, unit_m);
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
