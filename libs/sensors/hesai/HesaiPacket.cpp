#include "sensors/hesai/HesaiPacket.h"

#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodynePacket.h>

#include <ctime>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

constexpr std::size_t kHesaiHeader = 12, kHesaiTail = 28;
constexpr int kHesaiBlocks = 8;

std::size_t hesaiBlockBytes(int channels) { return 2 + 4 * static_cast<std::size_t>(channels); }

/// Reads the date, as years since 1900 to seconds, and the microseconds of the second.
std::uint64_t sensorTimeNs(const std::uint8_t* at) {
    std::tm date{};
    date.tm_year = at[0];
    date.tm_mon = at[1] - 1;
    date.tm_mday = at[2];
    date.tm_hour = at[3];
    date.tm_min = at[4];
    date.tm_sec = at[5];
    const auto seconds = static_cast<std::uint64_t>(timegm(&date));
    return 1000000000 * seconds + std::uint64_t{1000} * little<std::uint32_t>(at + 6);
}

}  // namespace

int HesaiPacket::azimuthOf(int firing) const {
    return little<std::uint16_t>(blocks + firing * returns * hesaiBlockBytes(channels));
}

double HesaiPacket::step() const {
    double turned = 0;
    for (int f = 0; f < firings(); ++f) {
        if (azimuthOf(f) >= kReadingsOfTurn) return -1;
        if (f == 0) continue;
        const double step = std::remainder(azimuthOf(f) - azimuthOf(f - 1), kReadingsOfTurn);
        if (step < 0 || step * firings() > kReadingsOfTurn / 8.0) return -1;
        turned += step;
    }
    return turned / (firings() - 1);
}

std::optional<HesaiPacket> hesaiPacketOf(const Datagram& datagram) {
    constexpr int kUnit_mm = 4;
    const std::uint8_t* const bytes = datagram.bytes;
    if (datagram.size < kHesaiHeader || bytes[0] != 0xee || bytes[1] != 0xff) return std::nullopt;
    const int channels = bytes[6], returns = bytes[10];
    const bool is_xt = (channels == 16 || channels == 32) && bytes[7] == kHesaiBlocks &&
                       bytes[9] == kUnit_mm && (returns == 1 || returns == 2);
    const std::size_t tail_at = kHesaiHeader + kHesaiBlocks * hesaiBlockBytes(channels);
    if (!is_xt || datagram.size != tail_at + kHesaiTail) return std::nullopt;
    const std::uint8_t* const tail = bytes + tail_at;
    return HesaiPacket{channels == 32 ? "XT32" : "XT16",
                       channels,
                       returns,
                       little<std::uint16_t>(tail + 24),
                       sensorTimeNs(tail + 13),
                       bytes + kHesaiHeader};
}

void appendReturns(const HesaiPacket& packet, const SensorModel& sensor, std::uint64_t start_ns,
                   Scan& scan) {
    constexpr double kFiring_s = 50e-6, kChannel_s = 1.512e-6;  // an XT16 fires every second time
    const int stride = 32 / packet.channels;
    const double packet_s =
        1e-9 * static_cast<double>(static_cast<std::int64_t>(packet.time_ns - start_ns));
    for (int block = 0; block < kHesaiBlocks; ++block) {
        const int firing = block / packet.returns;
        if (packet.azimuthOf(firing) >= kReadingsOfTurn) continue;
        const double azimuth_rad =
            -std::remainder(radians(0.01 * packet.azimuthOf(firing)), kTurn_rad);
        const double sine = std::sin(azimuth_rad), cosine = std::cos(azimuth_rad);
        const std::uint8_t* at = packet.blocks + block * hesaiBlockBytes(packet.channels) + 2;
        for (int channel = 0; channel < packet.channels; ++channel, at += 4) {
            const unsigned distance = little<std::uint16_t>(at);
            if (distance == 0) continue;
            const int row = packet.channels - 1 - channel;
            const auto elevation_rad = static_cast<double>(sensor.elevations_rad[row]);
            const double range_m = 0.004 * distance, level_m = range_m * std::cos(elevation_rad);
            scan.x_m.push_back(static_cast<float>(level_m * cosine));
            scan.y_m.push_back(static_cast<float>(level_m * sine));
            scan.z_m.push_back(static_cast<float>(range_m * std::sin(elevation_rad)));
            scan.intensity.push_back(static_cast<float>(at[2]) / 255.0f);
            scan.range_m.push_back(static_cast<float>(range_m));
            scan.azimuth_rad.push_back(static_cast<float>(azimuth_rad));
            scan.row.push_back(static_cast<std::uint8_t>(row));
            scan.time_s.push_back(
                static_cast<float>(packet_s + kFiring_s * firing + kChannel_s * stride * channel));
        }
    }
    scan.beams = beamSpan(sensor);
}

}  // namespace hagen::sensors
