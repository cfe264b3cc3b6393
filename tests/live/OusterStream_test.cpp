#include <gtest/gtest.h>
#include <hagen/live/LidarStream.h>
#include <hagen/live/SectorDistances.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/CaptureFile.h>
#include "sensors/ouster/OusterScan.h"

#include <algorithm>
#include <utility>

#include "support/Datagrams.h"
#include "support/OusterModes.h"
#include "support/OusterPackets.h"
#include "support/Program.h"

namespace hagen::live {
namespace {

using sensors::OusterFrame;
using sensors::OusterSensor;
using sensors::Taken;

Settings settingsOfFourBeams() {
    Settings settings;
    settings.options.columns = 64;
    settings.options.window_size = 2;
    settings.options.principal_components = 1;
    return settings;
}

class OusterStreamTest : public testing::Test {
 protected:
    /// The packets of frame `id`, each with 16 of its 64 columns.
    std::vector<std::string> packetsOf(std::uint16_t id) {
        frames_.push_back(test::randomFrame(sensor_, id));
        return test::packetsOf(sensor_, frames_.back());
    }
    Taken add(const std::string& packet) {
        time_s_ += 0.025;
        return stream_.add(test::datagramOf(packet), time_s_);
    }

    const OusterSensor sensor_ = sensors::ousterSensorOf(test::ousterJson(), "test");
    std::vector<OusterFrame> frames_;
    double time_s_ = 0;
    std::size_t returns_ = 0, labels_ = 0;
    std::vector<Sweep> swept_;
    LidarStream stream_{
        makeOusterDriver(sensor_), settingsOfFourBeams(), [this](const LabelledSector& sector) {
            returns_ += sector.returns.size();
            labels_ += sector.label.size();
            swept_.insert(swept_.end(), sector.packets->begin(), sector.packets->end());
        }};
};

TEST_F(OusterStreamTest, LabelsEachReturn) {
    std::size_t expected = 0;
    for (const int id : {65534, 65535, 0, 1}) {
        for (const auto& packet : packetsOf(static_cast<std::uint16_t>(id))) {
            EXPECT_EQ(add(packet), Taken::Yes);
        }
        expected += sensors::scanOf(frames_.back(), sensor_).size();
    }
    stream_.flush();
    EXPECT_EQ(returns_, expected);
    EXPECT_EQ(labels_, expected);
    EXPECT_GT(expected, 200u);
    EXPECT_EQ(stream_.counts().packets, 16u);
    EXPECT_EQ(stream_.counts().lost, 0u);
    EXPECT_EQ(stream_.counts().interruptions, 0u);
    ASSERT_EQ(swept_.size(), 16u);
    for (std::size_t p = 1; p < swept_.size(); ++p) {
        EXPECT_NEAR(swept_[p].from_rad, swept_[p - 1].to_rad, 1e-9) << p;
        EXPECT_NEAR(swept_[p].to_rad - swept_[p].from_rad, kPi / 2, 1e-9) << p;
    }
}

TEST_F(OusterStreamTest, SectorsHaveBeamOffsets) {
    BeamOffsets offsets;
    OusterSensor sensor = sensor_;
    sensor.azimuth_rad = {radians(2.0), radians(-0.5), radians(-3.0), radians(0.1)};
    LidarStream stream(makeOusterDriver(sensor), settingsOfFourBeams(),
                       [&](const LabelledSector& sector) { offsets = sector.offsets; });
    for (const auto& packet : packetsOf(7)) stream.add(test::datagramOf(packet), 0.01);
    stream.flush();
    EXPECT_NEAR(degrees(offsets.behind_rad), 2, 1e-9);  // azimuths are counter-clockwise
    EXPECT_NEAR(degrees(offsets.ahead_rad), 3, 1e-9);
}

/// The returns of a packet lie within its sweep.
TEST_F(OusterStreamTest, SweepMatchesReturns) {
    bool is_checked = false;
    LidarStream stream(
        makeOusterDriver(sensor_), settingsOfFourBeams(), [&](const LabelledSector& sector) {
            const double middle_rad = (sector.sweep->from_rad + sector.sweep->to_rad) / 2;
            const double half_rad = (sector.sweep->to_rad - sector.sweep->from_rad) / 2;
            for (std::size_t i = 0; i < sector.returns.size(); ++i) {
                if (sector.returns.range_m[i] < 1) continue;  // beams do not start at the origin
                const double off_rad = std::remainder(
                    -static_cast<double>(sector.returns.azimuth_rad[i]) - middle_rad, 2 * kPi);
                EXPECT_LT(std::abs(off_rad), half_rad + radians(12));  // pixels are staggered
                is_checked = true;
            }
        });
    for (const auto& packet : packetsOf(7)) {
        stream.add(test::datagramOf(packet), 0.01);
        stream.flush();
    }
    EXPECT_TRUE(is_checked);
}

TEST_F(OusterStreamTest, CountsLossesDuplicatesAndLatePackets) {
    for (const auto& packet : packetsOf(1)) add(packet);
    const auto second = packetsOf(2);
    add(second[0]);
    EXPECT_EQ(add(second[0]), Taken::Duplicate);
    add(second[2]);  // packet 1 arrives later
    EXPECT_EQ(add(second[1]), Taken::Yes);
    // Packet 3 is lost.
    for (int id = 3; id < 6; ++id) {
        for (const auto& packet : packetsOf(static_cast<std::uint16_t>(id))) add(packet);
    }
    EXPECT_EQ(stream_.counts().duplicate, 1u);
    EXPECT_EQ(stream_.counts().late, 1u);
    EXPECT_EQ(stream_.counts().lost, 1u);
    EXPECT_EQ(add(second[3]), Taken::TooLate);  // its frame is complete
    EXPECT_EQ(stream_.counts().too_late, 1u);
}

/// Columns that the sensor marked as invalid were not measured and do not belong to a sweep.
TEST_F(OusterStreamTest, InvalidColumnsAreNotSwept) {
    frames_.push_back(test::randomFrame(sensor_, 1));
    OusterFrame& frame = frames_.back();
    for (std::size_t column = 10; column < 40; ++column) {
        if (column != 12) frame.state[column] = OusterFrame::Column::Invalid;
    }
    const auto packets = test::packetsOf(sensor_, frame);
    const std::vector<Taken> expected{Taken::Yes, Taken::Unsound, Taken::Yes, Taken::Yes};
    for (std::size_t p = 0; p < packets.size(); ++p) EXPECT_EQ(add(packets[p]), expected[p]) << p;
    stream_.flush();
    const std::vector<std::pair<double, double>> columns{{0, 10}, {12, 13}, {40, 48}, {48, 64}};
    ASSERT_EQ(swept_.size(), columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const double column_rad = 2 * kPi / 64, first_rad = swept_[0].from_rad;
        EXPECT_NEAR((swept_[i].from_rad - first_rad) / column_rad, columns[i].first, 1e-9) << i;
        EXPECT_NEAR((swept_[i].to_rad - first_rad) / column_rad, columns[i].second, 1e-9) << i;
    }
    EXPECT_EQ(returns_, sensors::scanOf(frame, sensor_).size());
    EXPECT_EQ(stream_.counts().packets, 3u);
    EXPECT_EQ(stream_.counts().unsound, 1u);
}

TEST_F(OusterStreamTest, ResumesAfterRestart) {
    for (int id = 300; id < 310; ++id) {
        for (const auto& packet : packetsOf(static_cast<std::uint16_t>(id))) add(packet);
    }
    int late = 0, taken = 0;
    for (int id = 0; id < 10; ++id) {
        for (const auto& packet : packetsOf(static_cast<std::uint16_t>(id))) {
            const Taken one = add(packet);
            late += one == Taken::TooLate;
            taken += one == Taken::Yes;
        }
    }
    EXPECT_EQ(late, 16);
    EXPECT_EQ(taken, 24);
}

TEST_F(OusterStreamTest, DropsPacketsTurnsLate) {
    std::vector<std::string> late;
    for (int id = 0; id < 20; ++id) {
        const auto packets = packetsOf(static_cast<std::uint16_t>(id));
        if (id == 12) late = packets;
        for (const auto& packet : packets) EXPECT_EQ(add(packet), Taken::Yes);
    }
    for (const auto& packet : late) EXPECT_EQ(add(packet), Taken::TooLate);
    for (const auto& packet : packetsOf(20)) EXPECT_EQ(add(packet), Taken::Yes);
    EXPECT_EQ(stream_.counts().too_late, 4u);
    EXPECT_EQ(stream_.counts().interruptions, 0u);
    EXPECT_EQ(stream_.counts().packets, 84u);
}

TEST_F(OusterStreamTest, FrameJumpEndsContext) {
    for (const auto& packet : packetsOf(1)) add(packet);
    for (const auto& packet : packetsOf(500)) EXPECT_EQ(add(packet), Taken::Yes);
    for (const auto& packet : packetsOf(30000)) EXPECT_EQ(add(packet), Taken::Yes);
    EXPECT_EQ(stream_.counts().interruptions, 2u);
}

TEST_F(OusterStreamTest, RejectsOtherDatagrams) {
    EXPECT_EQ(add(std::string(48, 'x')), Taken::Auxiliary);
    EXPECT_EQ(add("noise"), Taken::WrongSize);
    EXPECT_EQ(add(std::string(sensor_.packetBytes(), '\0')), Taken::WrongSize);
    const OusterSensor other =
        sensors::ousterSensorOf(test::ousterJson("RNG19_RFL8_SIG16_NIR16", "17"), "test");
    EXPECT_EQ(add(test::packetsOf(other, test::randomFrame(other, 1)).front()), Taken::OtherSensor);
    EXPECT_EQ(stream_.counts().wrong_size, 2u);
    EXPECT_EQ(stream_.counts().other_sensor, 1u);
    EXPECT_EQ(stream_.counts().packets, 0u);
    EXPECT_EQ(stream_.segmenter().sectors(), 0u);
}

/// Columns would be placed in wrong directions, so all directions become unknown.
TEST(OusterStreams, DropsOtherModeInFlight) {
    for (const test::OusterMode& mode : {test::OusterMode{2048, 10}, test::OusterMode{512, 10}}) {
        const OusterSensor sensor = sensors::ousterSensorOf(test::ousterJsonOf({1024, 10}), "test");
        SectorDistances distances(*sensor.model);
        std::size_t sectors = 0;
        LidarStream stream(makeOusterDriver(sensor), settingsOfFourBeams(),
                           [&](const LabelledSector& sector) {
                               distances.take(sector);
                               ++sectors;
                           });
        test::TurningOuster ouster;
        double time_s = 0;
        const auto turn = [&](const test::OusterMode& now, std::size_t& taken) {
            const auto packets = ouster.turn(now);
            taken = 0;
            for (const std::string& packet : packets) {
                time_s += 0.1 / static_cast<double>(packets.size());
                taken += stream.add(test::datagramOf(packet), time_s) == Taken::Yes;
            }
        };
        const auto known = [&] {
            const auto at = distances.at(time_s);
            return std::count_if(at.begin(), at.end(), [](const auto& direction) {
                return direction.state != SectorDistances::State::Unknown;
            });
        };
        std::size_t taken = 0;
        for (int k = 0; k < 3; ++k) turn({1024, 10}, taken);
        EXPECT_EQ(taken, 64u);
        EXPECT_GT(known(), 70);
        for (int k = 0; k < 4; ++k) {
            turn(mode, taken);
            EXPECT_EQ(taken, 0u) << mode.text();
        }
        EXPECT_EQ(known(), 0) << mode.text();
        EXPECT_EQ(stream.counts().uncertain, 4 * mode.columns / 16);
        for (int k = 0; k < 3; ++k) turn({1024, 10}, taken);
        EXPECT_EQ(taken, 64u);
        EXPECT_GT(known(), 70);
    }
}

TEST(OusterStreams, RealCaptureLabelsMatchWholeTurns) {
    const auto folder = test::dataFolder("HAGEN_OUSTER_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_OUSTER_DATA is not a folder of captures";
    const OusterSensor sensor = sensors::readOusterSensor(folder / "OS-1-128_v2.3.0_1024x10.json");
    std::vector<Label> labels;
    LidarStream stream(makeOusterDriver(sensor), {}, [&](const LabelledSector& sector) {
        labels.insert(labels.end(), sector.label.begin(), sector.label.end());
    });
    sensors::OusterFrames frames(sensor);
    sensors::CaptureFile capture(folder / "OS-1-128_v2.3.0_1024x10_lb_n3.pcap");
    sensors::Datagram datagram;
    while (capture.next(datagram)) {
        stream.add(datagram, 1e-9 * static_cast<double>(datagram.time_ns));
        if (datagram.size == sensor.packetBytes()) frames.add(datagram.bytes, datagram.time_ns);
    }
    stream.flush();
    frames.finish();
    ASSERT_EQ(frames.complete().size(), 3u);
    HagenFilter filter(*sensor.model);
    std::size_t at = 0, same = 0, compared = 0, missed = 0, near = 0;
    for (std::size_t turn = 0; turn < 3; ++turn) {
        const Scan scan = sensors::scanOf(frames.complete()[turn], sensor);
        const std::vector<Label> whole = filter.segment(scan).returns.label;
        ASSERT_LE(at + whole.size(), labels.size());
        for (std::size_t i = 0; i < whole.size(); ++i, ++at) {
            if (turn == 0) continue;  // all returns are RoI until half a turn is known
            ++compared;
            same += labels[at] == whole[i];
            const bool is_near = whole[i] == Label::Roi && scan.range_m[i] < 5;
            near += is_near;
            missed += is_near && labels[at] != Label::Roi;
        }
    }
    EXPECT_EQ(at, labels.size());
    RecordProperty("same", std::to_string(same) + " of " + std::to_string(compared));
    RecordProperty("missed", std::to_string(missed) + " of " + std::to_string(near));
    EXPECT_GT(static_cast<double>(same), 0.98 * static_cast<double>(compared));
    EXPECT_LE(static_cast<double>(missed), 0.005 * static_cast<double>(near));
}

}  // namespace
}  // namespace hagen::live
