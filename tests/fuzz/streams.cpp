// A stream of LiDAR datagrams, some modified, truncated, late, lost or duplicated. No call throws;
// each datagram is accepted, or rejected and counted. Byte 0 of the input selects the sensor.
#include <hagen/live/LidarStream.h>
#include "sensors/ouster/OusterSensor.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "fuzz/AnyFilter.h"
#include "fuzz/SectorChecker.h"
#include "fuzz/Target.h"
#include "support/OusterPackets.h"

namespace hagen::fuzz {
namespace {

using live::LabelledSector;

template <class Number>
void put(std::string& bytes, std::size_t at, Number number) {
    std::memcpy(&bytes[at], &number, sizeof number);
}

/// The n-th packet of a Velodyne inside a circular wall.
std::string velodynePacket(std::size_t n, std::uint8_t model) {
    std::string bytes(1206, '\0');
    for (std::size_t block = 0; block < 12; ++block) {
        put(bytes, 100 * block, std::uint16_t{0xeeff});
        put(bytes, 100 * block + 2, static_cast<std::uint16_t>((n * 480 + block * 40) % 36000));
        for (std::size_t i = 0; i < 32; ++i) {
            put(bytes, 100 * block + 4 + 3 * i, static_cast<std::uint16_t>(2000 + 300 * (i % 4)));
        }
    }
    put(bytes, 1200, static_cast<std::uint32_t>(1330 * n));
    bytes[1204] = '\x37';
    bytes[1205] = static_cast<char>(model);
    return bytes;
}

/// The n-th packet of a Livox in the manufacturer's protocol, with 14 bytes per point.
std::string livoxPacket(std::size_t n) {
    constexpr std::size_t kPoints = 96;
    std::string bytes(36 + 14 * kPoints, '\0');
    put(bytes, 1, static_cast<std::uint16_t>(bytes.size()));
    put(bytes, 3, std::uint16_t{4800});
    put(bytes, 5, static_cast<std::uint16_t>(kPoints));
    put(bytes, 7, static_cast<std::uint16_t>(n));
    put(bytes, 10, std::uint8_t{1});
    put(bytes, 28, std::uint64_t{480000} * n);
    for (std::size_t i = 0; i < kPoints; ++i) {
        const auto x_mm = static_cast<std::int32_t>(4000 - 80 * i);
        put(bytes, 36 + 14 * i, x_mm);
        put(bytes, 40 + 14 * i, static_cast<std::int32_t>(5000 + 10 * n));
        put(bytes, 44 + 14 * i, static_cast<std::int32_t>(20 * i) - 900);
    }
    return bytes;
}

/// Settings with a small image, for speed.
Settings fewColumns() {
    Settings settings;
    settings.options.columns = 128;
    return settings;
}

/// The packets of any sensor.
struct AnyLidar {
    std::unique_ptr<sensors::LidarDriver> driver;
    Settings settings = fewColumns();
    std::function<std::string(std::size_t n)> packet;
};

AnyLidar anyVelodyne(const char* name, std::uint8_t number) {
    return {sensors::makeDriver(name), fewColumns(),
            [number](std::size_t n) { return velodynePacket(n, number); }};
}

AnyLidar anyOuster() {
    const sensors::OusterSensor sensor = sensors::ousterSensorOf(test::ousterJson(), "made");
    Settings settings = fewColumns();  // four beams
    settings.options.window_size = 2;
    settings.options.principal_components = 1;
    return {sensors::makeOusterDriver(sensor), settings, [sensor](std::size_t n) {
                const auto frame = static_cast<std::uint16_t>(n / 4);
                const auto packets = test::packetsOf(sensor, test::randomFrame(sensor, frame));
                return packets[n % 4 % packets.size()];
            }};
}

AnyLidar anyLidar(std::size_t kind) {
    if (kind == 0) return anyVelodyne("VLP-16", 0x22);
    if (kind == 1) return anyVelodyne("HDL-32E", 0x21);
    if (kind == 2) return anyOuster();
    return {sensors::makeDriver("Mid-360"), fewColumns(), livoxPacket};
}

/// Total number of counted datagrams.
std::size_t counted(const sensors::PacketCounts& c) {
    return c.packets + c.wrong_size + c.other_sensor + c.auxiliary + c.duplicate + c.unsound +
           c.too_late + c.uncertain;
}

/// Each datagram uses four bytes of the input, plus three per changed byte.
void streamDatagrams(std::string_view input) {
    Parts parts(input);
    std::unique_ptr<SectorChecker> checker;
    AnyLidar lidar = anyLidar(parts.below(4));
    live::LidarStream stream(std::move(lidar.driver), lidar.settings,
                             [&](const LabelledSector& sector) { checker->take(sector); });
    checker = std::make_unique<SectorChecker>(stream.segmenter().sensor());
    std::size_t n = 0, given = 0;
    double now_s = 1;
    while (!parts.isAtEnd() && given < 120) {
        const auto skipped = static_cast<std::size_t>(parts.number<std::int8_t>());
        std::string bytes = lidar.packet(n + skipped);
        for (std::size_t changes = parts.below(8); changes > 0; --changes) {
            const std::size_t at = parts.number<std::uint16_t>() % bytes.size();
            bytes[at] = static_cast<char>(parts.number<std::uint8_t>());
        }
        const std::uint8_t cut = parts.number<std::uint8_t>();
        if (cut > 250) bytes.erase(bytes.size() - std::min<std::size_t>(cut % 8, bytes.size()));
        sensors::Datagram datagram;
        datagram.time_ns = static_cast<std::int64_t>(1e9 * now_s);
        datagram.bytes = reinterpret_cast<const std::uint8_t*>(bytes.data());
        datagram.size = bytes.size();
        stream.add(datagram, now_s);
        require(counted(stream.counts()) == ++given, "a datagram was not counted once");
        now_s += 1e-3 * parts.number<std::uint8_t>();
        ++n;
        if (cut == 250) stream.flush();
        if (cut == 249) {
            const std::optional<Attitude> tilt = anyTilt(parts);
            stream.move({tilt, anyPose(parts)});
        }
    }
    stream.flush();
}

Seeds datagrams() {
    Seeds seeds;
    for (const char kind : {'\0', '\1', '\2', '\3'}) {
        std::string sound(1, kind), odd = sound;
        for (std::size_t i = 0; i < 80; ++i) {
            sound += bytesOf(std::int8_t{0}, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{1});
            odd += bytesOf(static_cast<std::int8_t>(i % 11 == 3 ? -2 : 0), std::uint8_t{1},
                           static_cast<std::uint16_t>(101 * i), static_cast<std::uint8_t>(7 * i),
                           static_cast<std::uint8_t>(i % 13 == 5 ? 251 : 0),
                           static_cast<std::uint8_t>(1 + i % 3));
        }
        seeds.push_back(sound);
        seeds.push_back(odd);
    }
    return seeds;
}

const bool kAdded = add({"streams", streamDatagrams, datagrams, {}, 1000});

}  // namespace
}  // namespace hagen::fuzz
