#include <gtest/gtest.h>
#include <hagen/range_image/Angle.h>
#include <hagen/streaming/LivoxStream.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hagen::streaming {
namespace {

using Taken = LivoxStream::Taken;

constexpr int kPoints = 96;
constexpr std::int64_t kPacket_ns = 480000;  // 200 000 points per second

void put(std::string& bytes, std::int64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

/// A packet of points all around, 2 m above flat ground with a wall at x = 6.
std::string packetOf(int number, std::int64_t time_ns) {
    std::string bytes;
    put(bytes, 0, 1);
    put(bytes, 36 + kPoints * 14, 2);
    put(bytes, 4800, 2);
    put(bytes, kPoints, 2);
    put(bytes, number, 2);
    put(bytes, 0, 1);
    put(bytes, 1, 1);
    bytes += std::string(1 + 12 + 4, '\0');
    put(bytes, time_ns, 8);
    std::mt19937 random(static_cast<unsigned>(number));
    for (int i = 0; i < kPoints; ++i) {
        const double azimuth_rad = radians(static_cast<double>(random() % 3600) / 10 - 180);
        const double elevation_rad = radians(static_cast<double>(random() % 590) / 10 - 7);
        const double x = std::cos(azimuth_rad) * std::cos(elevation_rad);
        const double y = std::sin(azimuth_rad) * std::cos(elevation_rad);
        const double z = std::sin(elevation_rad);
        double range_m = z < 0 ? 2 / -z : 0;
        const double wall_m = x > 0.1 ? 6 / x : 1e9;
        if (wall_m * z < 4 && (range_m == 0 || wall_m < range_m) && wall_m < 40) range_m = wall_m;
        if (range_m > 60) range_m = 0;
        for (const double c : {x, y, z}) put(bytes, std::lround(1000 * range_m * c), 4);
        put(bytes, 100, 1);
        put(bytes, 0, 1);
    }
    return bytes;
}

class LivoxStreamTest : public testing::Test {
 protected:
    Taken add(const std::string& packet, double time_s) {
        return stream_.add(reinterpret_cast<const std::uint8_t*>(packet.data()), packet.size(),
                           time_s);
    }
    struct Frame {
        std::size_t returns, roi_of_wall, wall;
        double first_s, last_s;
        bool has_turn;
    };
    std::vector<Frame> frames_;
    LivoxStream stream_{
        {}, [this](const LabelledSector& sector) {
            EXPECT_FALSE(sector.sweep);
            Frame frame{sector.returns.size(), 0, 0, sector.first_time_s, sector.last_time_s,
                        sector.has_turn};
            for (std::size_t i = 0; i < frame.returns; ++i) {
                const bool is_wall = std::abs(sector.returns.x_m[i] - 6) < 0.01f &&
                                     sector.returns.z_m[i] > -1 && sector.returns.range_m[i] < 20;
                frame.wall += is_wall;
                frame.roi_of_wall += is_wall && sector.label[i] == Label::Roi;
            }
            frames_.push_back(frame);
        }};
};

TEST_F(LivoxStreamTest, FramesAreTwentyMilliseconds) {
    for (int i = 0; i < 420; ++i) {
        EXPECT_EQ(add(packetOf(i, 1000000000 + kPacket_ns * i), 1e-9 * kPacket_ns * i), Taken::Yes);
    }
    EXPECT_NEAR(static_cast<double>(frames_.size()), 10, 1);
    EXPECT_FALSE(frames_[0].has_turn);
    std::size_t wall = 0, found = 0;
    for (const Frame& frame : frames_) {
        EXPECT_GT(frame.returns, 500u);
        wall += frame.wall;
        found += frame.roi_of_wall;
    }
    EXPECT_GT(wall, 500u);
    EXPECT_EQ(found, wall);
}

TEST_F(LivoxStreamTest, LossesRepetitionsAndJumpsAreCounted) {
    const auto packet = [](int i, std::int64_t offset_ns = 0) {
        return packetOf(i, 5000000000 + offset_ns + kPacket_ns * i);
    };
    double time_s = 0;
    for (const int i : {0, 1, 1, 2, 5, 6, 8, 7, 9}) add(packet(i), time_s += 5e-4);
    add(packet(10, -4000000000), time_s += 5e-4);  // the clock was set
    const auto& counts = stream_.counts();
    EXPECT_EQ(counts.repeated, 1u);
    EXPECT_EQ(counts.lost, 2u);
    EXPECT_EQ(counts.late, 1u);
    EXPECT_EQ(counts.interruptions, 1u);
    EXPECT_EQ(counts.packets, 9u);
}

TEST_F(LivoxStreamTest, ForeignDatagramsAreRefused) {
    EXPECT_EQ(add("", 0), Taken::Foreign);
    EXPECT_EQ(add(std::string(1206, 'x'), 0), Taken::Foreign);
    EXPECT_EQ(add(packetOf(0, 0).substr(2), 0), Taken::Foreign);
    stream_.flush();
    EXPECT_TRUE(frames_.empty());
    EXPECT_EQ(stream_.counts().foreign, 3u);
}

}  // namespace
}  // namespace hagen::streaming
