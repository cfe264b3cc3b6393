#include <gtest/gtest.h>
#include <hagen/live/LidarStream.h>
#include <hagen/live/SectorDistances.h>

#include <cmath>

#include "support/Datagrams.h"
#include "support/LivoxPackets.h"

namespace hagen::live {
namespace {

using sensors::Taken;

constexpr int kPoints = test::kLivoxPoints;
constexpr std::int64_t kPacket_ns = test::kLivoxPacket_ns;
const auto livoxPacketOf = test::livoxPacketOfWall;

class LivoxStreamTest : public testing::Test {
 protected:
    Taken add(const std::string& packet, double time_s) {
        return stream_.add(test::datagramOf(packet), time_s);
    }
    struct Frame {
        std::size_t returns, roi_of_wall, wall;
        double first_s, last_s;
        bool has_turn;
    };
    std::vector<Frame> frames_;
    LidarStream stream_{
        sensors::makeDriver("Mid-360"), {}, [this](const LabelledSector& sector) {
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

TEST_F(LivoxStreamTest, FramesLastTwentyMilliseconds) {
    for (int i = 0; i < 420; ++i) {
        EXPECT_EQ(add(livoxPacketOf(i, 1000000000 + kPacket_ns * i), 1e-9 * kPacket_ns * i),
                  Taken::Yes);
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

TEST_F(LivoxStreamTest, CountsLossesDuplicatesAndJumps) {
    const auto packet = [](int i, std::int64_t offset_ns = 0) {
        return livoxPacketOf(i, 5000000000 + offset_ns + kPacket_ns * i);
    };
    double time_s = 0;
    for (const int i : {0, 1, 1, 2, 5, 6, 8, 7, 9}) add(packet(i), time_s += 5e-4);
    for (const int i : {10, 11, 12, 13}) {  // after a clock step
        add(packet(i, -4000000000), time_s += 5e-4);
    }
    const auto& counts = stream_.counts();
    EXPECT_EQ(counts.duplicate, 1u);
    EXPECT_EQ(counts.lost, 2u);
    EXPECT_EQ(counts.late, 4u);  // three of them before the clock step is detected
    EXPECT_EQ(counts.interruptions, 1u);
    EXPECT_EQ(counts.packets, 9u);
}

/// PTP may step the clock. Later packets are neither late nor held back until the clock catches up.
TEST_F(LivoxStreamTest, ClockStepBackDoesNotDelayPackets) {
    for (const std::int64_t back_ns : {20000000, 200000000, 900000000, 2000000000}) {
        frames_.clear();
        LidarStream stream(sensors::makeDriver("Mid-360"), {},
                           [this](const LabelledSector& sector) {
                               frames_.push_back({sector.returns.size(), 0, 0, sector.first_time_s,
                                                  sector.last_time_s, sector.has_turn});
                           });
        for (int i = 0; i < 1000; ++i) {
            const std::int64_t time_ns = 5000000000 + kPacket_ns * i - (i < 500 ? 0 : back_ns);
            const std::string packet = livoxPacketOf(i, time_ns);
            stream.add(test::datagramOf(packet), 1 + 1e-9 * kPacket_ns * i);
        }
        EXPECT_EQ(stream.counts().interruptions, 1u);
        EXPECT_EQ(stream.counts().late, 3u);
        EXPECT_EQ(stream.counts().too_late, 3u);
        EXPECT_EQ(stream.counts().packets, 997u);
        EXPECT_NEAR(static_cast<double>(frames_.size()), 24, 2);
        double latest_s = 1;
        for (const Frame& frame : frames_) {
            EXPECT_LT(frame.last_s - frame.first_s, 0.021);
            EXPECT_LT(frame.last_s - latest_s, 0.025);
            latest_s = frame.last_s;
        }
    }
}

/// Each packet arrives twice, as over a second network: at once or after some later packets.
TEST_F(LivoxStreamTest, ClockStepBackToleratesDuplicates) {
    for (const std::int64_t back_ns : {20000000, 200000000, 2000000000}) {
        for (const int later : {0, 1, 3}) {
            LidarStream stream(sensors::makeDriver("Mid-360"), {}, [](const LabelledSector&) {});
            const auto addTo = [&](int i, int now) {
                const std::int64_t time_ns = 5000000000 + kPacket_ns * i - (i < 500 ? 0 : back_ns);
                const std::string packet = livoxPacketOf(i, time_ns);
                return stream.add(test::datagramOf(packet), 1 + 1e-9 * kPacket_ns * now);
            };
            for (int i = 0; i < 1000; ++i) {
                addTo(i, i);
                if (i < later) continue;
                EXPECT_EQ(addTo(i - later, i), Taken::Duplicate);
            }
            EXPECT_EQ(stream.counts().interruptions, 1u) << back_ns << " " << later;
            // Copies from before the step arrive among the first packets after it.
            const auto too_late = static_cast<std::size_t>(3 + later);
            EXPECT_EQ(stream.counts().too_late, too_late) << back_ns << " " << later;
            EXPECT_EQ(stream.counts().packets, 1000 - too_late) << back_ns << " " << later;
        }
    }
}

/// Packets delayed by a network are older than those that arrive with them.
TEST_F(LivoxStreamTest, DropsPacketsFarTooLate) {
    const auto packet = [](int i) { return livoxPacketOf(i, 5000000000 + kPacket_ns * i); };
    double time_s = 0;
    for (int i = 0; i < 400; ++i) add(packet(i), time_s += 4.8e-4);
    EXPECT_EQ(add(packet(500), time_s += 4.8e-4), Taken::Yes);
    for (int i = 420; i < 423; ++i) {
        EXPECT_EQ(add(packet(i), time_s += 4.8e-4), Taken::TooLate);
    }
    EXPECT_EQ(add(packet(501), time_s += 4.8e-4), Taken::Yes);
    EXPECT_EQ(add(packet(423), time_s += 4.8e-4), Taken::TooLate);
    EXPECT_EQ(add(packet(490), time_s += 4.8e-4), Taken::Yes);
    EXPECT_EQ(add(livoxPacketOf(502, 5000000000 - 1200000000), time_s += 4.8e-4), Taken::TooLate);
    EXPECT_EQ(add(packet(503), time_s += 4.8e-4), Taken::Yes);
    for (int i = 0; i < 300; ++i) {  // duplicates from a slower path
        EXPECT_EQ(add(packet(i), time_s += 1e-6), Taken::Duplicate);
    }
    EXPECT_EQ(stream_.counts().too_late, 5u);
    EXPECT_EQ(stream_.counts().late, 6u);
    EXPECT_EQ(stream_.counts().interruptions, 0u);
}

/// A frame in progress does not extend beyond a silence.
TEST_F(LivoxStreamTest, FrameEndsAtSilence) {
    SectorDistances distances(sensorModel("Mid-360"));
    LidarStream stream(sensors::makeDriver("Mid-360"), {}, [&](const LabelledSector& sector) {
        frames_.push_back({sector.returns.size(), 0, 0, sector.first_time_s, sector.last_time_s,
                           sector.has_turn});
        distances.take(sector);
    });
    const auto addTo = [&](const std::string& packet, double time_s) {
        stream.add(test::datagramOf(packet), time_s);
    };
    for (int i = 0; i < 500; ++i) {
        addTo(livoxPacketOf(i, 5000000000 + kPacket_ns * i), 1e-9 * kPacket_ns * i);
    }
    const std::size_t before = frames_.size();
    const int again = 500 + 1875;  // 0.9 s
    const double now_s = 1e-9 * kPacket_ns * again;
    addTo(test::livoxPacket(std::vector<test::LivoxPoint>(kPoints, {0, 0, 0, 0}),
                            5000000000 + kPacket_ns * again, again),
          now_s);
    ASSERT_EQ(frames_.size(), before + 1);
    EXPECT_LT(frames_.back().last_s, 0.241);
    stream.flush();
    for (const auto& sector : distances.at(now_s)) {
        EXPECT_EQ(sector.state, SectorDistances::State::Unknown);
    }
    // A frame spans its first to its last packet.
    for (std::size_t i = 0; i < before; ++i) {
        EXPECT_NEAR(frames_[i].last_s - frames_[i].first_s, 0.0197, 0.001);
    }
}

/// Of ten packets, six are lost and four arrive twice: only 40 % of the time was measured.
TEST_F(LivoxStreamTest, DuplicatesDoNotReplaceLostPackets) {
    double measured_s = 0;
    SectorDistances distances(sensorModel("Mid-360"));
    LidarStream stream(sensors::makeDriver("Mid-360"), {}, [&](const LabelledSector& sector) {
        measured_s += sector.measured_s;
        distances.take(sector);
    });
    const auto addTo = [&](const std::string& packet, double time_s) {
        return stream.add(test::datagramOf(packet), time_s);
    };
    const std::vector<test::LivoxPoint> nothing(kPoints, {0, 0, 0, 0});
    std::string before;
    for (int i = 0; i < 1000; ++i) {
        if (i % 10 >= 4) continue;
        const double time_s = 1 + 1e-9 * kPacket_ns * i;
        const std::string packet = test::livoxPacket(nothing, 1000000000 + kPacket_ns * i, i);
        EXPECT_EQ(addTo(packet, time_s), Taken::Yes);
        if (!before.empty()) {
            EXPECT_EQ(addTo(before, time_s), Taken::Duplicate);
        }
        before = packet;
    }
    stream.flush();
    EXPECT_EQ(stream.counts().duplicate, 399u);
    EXPECT_EQ(stream.counts().late, 0u);
    EXPECT_NEAR(measured_s, 0.4 * 1e-9 * kPacket_ns * 1000, 1e-6);
    for (const auto& sector : distances.at(1 + 1e-9 * kPacket_ns * 1000)) {
        EXPECT_EQ(sector.state, SectorDistances::State::Unknown);
    }
}

/// With few returns around it, a near return may be an obstacle.
TEST_F(LivoxStreamTest, HeavyPacketLossMakesSectorsDoubtful) {
    double measured_s = 0;
    std::size_t sectors = 0, doubtful = 0;
    const auto fly = [&](int every) {
        measured_s = 0;
        sectors = doubtful = 0;
        LidarStream stream(sensors::makeDriver("Mid-360"), {}, [&](const LabelledSector& sector) {
            measured_s += sector.measured_s;
            ++sectors;
            doubtful += sector.is_doubtful;
        });
        for (int i = 0; i < 2000; i += every) {
            const std::string packet = livoxPacketOf(i, 1000000000 + kPacket_ns * i);
            stream.add(test::datagramOf(packet), 1e-9 * kPacket_ns * i);
        }
    };
    fly(1);
    EXPECT_NEAR(measured_s, 1e-9 * kPacket_ns * 2000, 0.021);
    EXPECT_GT(sectors, 40u);
    EXPECT_LT(doubtful, 6u);
    fly(42);
    EXPECT_NEAR(measured_s, 1e-9 * kPacket_ns * 2000 / 42, 0.001);
    EXPECT_EQ(doubtful, sectors);
}

TEST_F(LivoxStreamTest, RejectsForeignDatagrams) {
    EXPECT_EQ(add("", 0), Taken::WrongSize);
    EXPECT_EQ(add(std::string(1206, 'x'), 0), Taken::WrongSize);
    EXPECT_EQ(add(livoxPacketOf(0, 0).substr(2), 0), Taken::WrongSize);
    stream_.flush();
    EXPECT_TRUE(frames_.empty());
    EXPECT_EQ(stream_.counts().wrong_size, 3u);
}

}  // namespace
}  // namespace hagen::live
