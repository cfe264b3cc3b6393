// Datagrams of a LiDAR, one after the other: sound ones, and those with any bytes changed, cut off,
// late, lost or repeated. Nothing throws, and each is taken, or refused and counted. The first byte
// of the input names the sensor.
#include <hagen/live/LivoxStream.h>
#include <hagen/live/OusterStream.h>
#include <hagen/live/VelodyneStream.h>

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

/// The n-th packet of a Velodyne in a ring of wall.
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

/// The n-th packet of a Livox, of the maker's protocol: points of 14 bytes.
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

/// A small image, which is fast.
Settings fewColumns() {
    Settings settings;
    settings.options.columns = 128;
    return settings;
}

/// A stream of any sensor, as this file needs it.
struct AnyStream {
    virtual ~AnyStream() = default;
    virtual std::string packet(std::size_t n) = 0;
    virtual void add(const std::string& bytes, double time_s) = 0;
    virtual void flush() = 0;
    virtual void move(const std::optional<Attitude>& tilt,
                      const std::optional<Eigen::Isometry3d>& pose) = 0;
    /// Of datagrams, those that were counted.
    virtual std::size_t counted() const = 0;
};

live::StreamingSegmenter::Take into(std::unique_ptr<SectorChecker>& checker) {
    return [&checker](const LabelledSector& sector) { checker->take(sector); };
}

const std::uint8_t* bytesAt(const std::string& bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

/// What all streams have. `made_of`: what its constructor takes before the function.
template <class Stream>
struct StreamOf : AnyStream {
    template <class... Part>
    explicit StreamOf(std::unique_ptr<SectorChecker>& checker, const Part&... made_of)
        : stream(made_of..., into(checker)) {
        checker = std::make_unique<SectorChecker>(stream.segmenter().sensor());
    }
    void flush() override { stream.flush(); }
    void move(const std::optional<Attitude>& tilt,
              const std::optional<Eigen::Isometry3d>& pose) override {
        stream.setAttitude(tilt);
        stream.setPose(pose);
    }

    Stream stream;
};

struct AnyVelodyne : StreamOf<live::VelodyneStream> {
    AnyVelodyne(const char* name, std::uint8_t model_number,
                std::unique_ptr<SectorChecker>& checker)
        : StreamOf(checker, sensors::velodyneModel(name), fewColumns()), number(model_number) {}
    std::string packet(std::size_t n) override { return velodynePacket(n, number); }
    void add(const std::string& bytes, double time_s) override {
        stream.add(bytesAt(bytes), bytes.size(), time_s);
    }
    std::size_t counted() const override {
        const auto& c = stream.counts();
        return c.packets + c.wrong_size + c.other_model + c.repeated + c.unsound + c.too_late;
    }

    std::uint8_t number;
};

Settings settingsOfFourBeams() {
    Settings settings = fewColumns();
    settings.options.window_size = 2;
    settings.options.principal_components = 1;
    return settings;
}

struct AnyOuster : StreamOf<live::OusterStream> {
    AnyOuster(const sensors::OusterSensor& made, std::unique_ptr<SectorChecker>& checker)
        : StreamOf(checker, made, settingsOfFourBeams()), sensor(made) {}
    std::string packet(std::size_t n) override {
        if (n / 4 != frame || packets.empty()) {
            frame = n / 4;
            packets = test::packetsOf(sensor,
                                      test::randomFrame(sensor, static_cast<std::uint16_t>(frame)));
        }
        return packets[n % 4 % packets.size()];
    }
    void add(const std::string& bytes, double time_s) override {
        stream.add(bytesAt(bytes), bytes.size(), time_s, static_cast<std::int64_t>(1e9 * time_s));
        stream.complete().clear();
    }
    std::size_t counted() const override {
        const auto& c = stream.counts();
        return c.packets + c.wrong_size + c.other_sensor + c.imu + c.repeated + c.unsound +
               c.too_late + c.uncertain;
    }

    sensors::OusterSensor sensor;
    std::size_t frame = 0;
    std::vector<std::string> packets;
};

struct AnyLivox : StreamOf<live::LivoxStream> {
    explicit AnyLivox(std::unique_ptr<SectorChecker>& checker) : StreamOf(checker, fewColumns()) {}
    std::string packet(std::size_t n) override { return livoxPacket(n); }
    void add(const std::string& bytes, double time_s) override {
        stream.add(bytesAt(bytes), bytes.size(), time_s);
    }
    std::size_t counted() const override {
        const auto& c = stream.counts();
        return c.packets + c.imu + c.foreign + c.repeated + c.too_late;
    }
};

std::unique_ptr<AnyStream> anyStream(std::size_t kind, std::unique_ptr<SectorChecker>& checker) {
    if (kind == 0) return std::make_unique<AnyVelodyne>("VLP-16", 0x22, checker);
    if (kind == 1) return std::make_unique<AnyVelodyne>("HDL-32E", 0x21, checker);
    if (kind == 2) {
        return std::make_unique<AnyOuster>(sensors::ousterSensorOf(test::ousterJson(), "made"),
                                           checker);
    }
    return std::make_unique<AnyLivox>(checker);
}

/// Each datagram takes four bytes of the input, and three for each byte of it that is changed.
void streamDatagrams(std::string_view input) {
    Parts parts(input);
    std::unique_ptr<SectorChecker> checker;
    const auto stream = anyStream(parts.below(4), checker);
    std::size_t n = 0, given = 0;
    double now_s = 1;
    while (!parts.isAtEnd() && given < 120) {
        const auto skipped = static_cast<std::size_t>(parts.number<std::int8_t>());
        std::string bytes = stream->packet(n + skipped);
        for (std::size_t changes = parts.below(8); changes > 0; --changes) {
            const std::size_t at = parts.number<std::uint16_t>() % bytes.size();
            bytes[at] = static_cast<char>(parts.number<std::uint8_t>());
        }
        const std::uint8_t cut = parts.number<std::uint8_t>();
        if (cut > 250) bytes.resize(bytes.size() - cut % 8);
        stream->add(bytes, now_s);
        require(stream->counted() == ++given, "a datagram was not counted once");
        now_s += 1e-3 * parts.number<std::uint8_t>();
        ++n;
        if (cut == 250) stream->flush();
        if (cut == 249) stream->move(anyTilt(parts), anyPose(parts));
    }
    stream->flush();
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
