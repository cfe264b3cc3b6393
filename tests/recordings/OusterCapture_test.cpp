#include <hagen/scan/Angle.h>
#include "sensors/ouster/OusterFrames.h"

#include <Eigen/Geometry>
#include <cmath>

#include "support/CaptureTest.h"
#include "support/OusterModes.h"
#include "support/OusterPackets.h"
#include "support/Random.h"
#include "support/RawBytes.h"

namespace hagen::recordings {
namespace {

using test::CaptureWriter;
using testing::HasSubstr;
using testing::Not;

class OusterCaptureTest : public test::CaptureTest {
 protected:
    sensors::OusterSensor sensorOf(const std::string& profile) {
        json_ = folder_.write("sensor.json", test::ousterJson(profile));
        return sensors::readOusterSensor(json_);
    }
    static CaptureWriter captureOf(const std::vector<std::string>& packets) {
        return CaptureWriter().datagrams(packets, 1e-3, 7502);
    }
    std::vector<std::string> packetsOfFrames(const sensors::OusterSensor& sensor, int count,
                                             std::uint16_t first_id = 100) const {
        std::vector<std::string> packets;
        for (int i = 0; i < count; ++i) {
            const auto of_frame = test::packetsOf(
                sensor, test::randomFrame(sensor, static_cast<std::uint16_t>(first_id + i)));
            packets.insert(packets.end(), of_frame.begin(), of_frame.end());
        }
        return packets;
    }
    static Scan scanOf(const mrpt::obs::CObservation& observation) {
        return observedOf(observation).scan;
    }
};

const char* const kProfiles[] = {"LEGACY",
                                 "RNG19_RFL8_SIG16_NIR16",
                                 "RNG19_RFL8_SIG16_NIR16_DUAL",
                                 "RNG19_RFL8_SIG16_NIR16_ZONE16",
                                 "RNG15_RFL8_NIR8",
                                 "RNG15_RFL8_WIN8",
                                 "RNG15_RFL8_NIR8_ZONE16",
                                 "RNG15_RFL8_NIR8_DUAL",
                                 "FUSA_RNG15_RFL8_NIR8_DUAL",
                                 "FIVE_WORD_PIXEL"};

TEST_F(OusterCaptureTest, ReadsAllProfiles) {
    for (const std::string profile : kProfiles) {
        SCOPED_TRACE(profile);
        const sensors::OusterSensor sensor = sensorOf(profile);
        sensors::OusterFrames frames(sensor);
        sensors::OusterFrame sent = test::randomFrame(sensor, 65535);
        sent.state[5] = sensors::OusterFrame::Column::Invalid;
        for (const std::string& packet : test::packetsOf(sensor, sent)) {
            ASSERT_EQ(packet.size(), sensor.packetBytes());
            frames.add(reinterpret_cast<const std::uint8_t*>(packet.data()), 12);
        }
        frames.finish();
        ASSERT_EQ(frames.complete().size(), 1u);
        const sensors::OusterFrame& got = frames.complete().front();
        EXPECT_EQ(got.id, 65535);
        EXPECT_EQ(got.time_ns, 12);
        EXPECT_EQ(got.range, sent.range);
        EXPECT_EQ(got.reflectivity, sent.reflectivity);
        EXPECT_EQ(got.second_range, sent.second_range);
        EXPECT_EQ(got.second_reflectivity, sent.second_reflectivity);
        EXPECT_EQ(got.column_time_ns, sent.column_time_ns);
        EXPECT_EQ(got.state, sent.state);
        EXPECT_EQ(frames.counts().invalid_columns, 1u);
    }
}

/// The position of a pixel's return. Rotates the parts of the sensor instead of using the manual's
/// formula: the beam starts on the head, which turns clockwise, at a distance from the axis.
Eigen::Vector3d expectedPoint(const sensors::OusterSensor& sensor, std::size_t pixel,
                              std::size_t column, double range_m) {
    const double turned_rad =
        -2 * kPi * static_cast<double>(column) / static_cast<double>(sensor.columns_per_frame);
    const Eigen::AngleAxisd head(turned_rad, Eigen::Vector3d::UnitZ());
    const Eigen::AngleAxisd aside(sensor.azimuth_rad[pixel], Eigen::Vector3d::UnitZ());
    const Eigen::AngleAxisd up(-sensor.altitude_rad[pixel], Eigen::Vector3d::UnitY());
    const Eigen::Vector3d beam = aside * (up * Eigen::Vector3d::UnitX());
    const Eigen::Vector3d origin(sensor.beam_origin_m, 0, 0);
    const Eigen::Vector3d in_lidar = head * (origin + (range_m - sensor.beam_origin_m) * beam);
    return {-in_lidar.x(), -in_lidar.y(), in_lidar.z()};
}

TEST_F(OusterCaptureTest, ReturnsMatchGeometry) {
    for (const std::string profile : kProfiles) {
        SCOPED_TRACE(profile);
        const sensors::OusterSensor sensor = sensorOf(profile);
        const sensors::OusterFrame frame = test::randomFrame(sensor, 7);
        const Scans scans = read(captureOf(test::packetsOf(sensor, frame)).bytes());
        ASSERT_EQ(scans.size(), 1u);
        EXPECT_EQ(broken_, "");
        const Scan scan = scanOf(*scans[0]);
        const double unit_m = profile.find("RNG15") == std::string::npos ? 0.001 : 0.008;
        std::size_t i = 0;
        const auto expectReturn = [&](std::size_t pixel, std::size_t column, double range_m,
                                      std::uint8_t reflectivity) {
            ASSERT_LT(i, scan.size());
            const Eigen::Vector3d at = expectedPoint(sensor, pixel, column, range_m);
            ASSERT_NEAR(scan.x_m[i], at.x(), 1e-4);
            ASSERT_NEAR(scan.y_m[i], at.y(), 1e-4);
            ASSERT_NEAR(scan.z_m[i], at.z(), 1e-4);
            ASSERT_NEAR(scan.range_m[i], at.norm(), 1e-4);
            ASSERT_EQ(scan.row[i], 3 - pixel);
            ASSERT_NEAR(scan.intensity[i], reflectivity / 255.0, 1e-6);
            ASSERT_NEAR(scan.time_s[i], 1e-3 * static_cast<double>(column), 1e-6);
            ++i;
        };
        for (std::size_t column = 0; column < 64; ++column) {
            for (std::size_t pixel = 0; pixel < 4; ++pixel) {
                const std::size_t at = frame.at(pixel, column);
                if (frame.range[at] > 0) {
                    expectReturn(pixel, column, unit_m * frame.range[at], frame.reflectivity[at]);
                }
                if (!frame.second_range.empty() && frame.second_range[at] > 0) {
                    expectReturn(pixel, column, unit_m * frame.second_range[at],
                                 frame.second_reflectivity[at]);
                }
            }
        }
        EXPECT_EQ(i, scan.size());
        EXPECT_NEAR(scans[0]->sensorPose().z, 0.03618, 1e-9);
        EXPECT_EQ(scans[0]->sensorLabel, "ouster");
    }
}

TEST_F(OusterCaptureTest, ReportsOtherFusaSensor) {
    const sensors::OusterSensor sensor = sensorOf("FUSA_RNG15_RFL8_NIR8_DUAL");
    const std::string bytes = captureOf(packetsOfFrames(sensor, 2)).bytes();
    json_ = folder_.write("other.json", test::ousterJson("FUSA_RNG15_RFL8_NIR8_DUAL", "123"));
    EXPECT_TRUE(read(bytes).empty());
    EXPECT_THAT(broken_, HasSubstr("8 packets from another sensor (serial number 992137000142)"));
}

TEST_F(OusterCaptureTest, FirstColumnLooksForward) {
    // Column 0 points along the LiDAR's x axis, to the rear of the sensor.
    const sensors::OusterSensor sensor = sensorOf("LEGACY");
    sensors::OusterFrame frame = test::randomFrame(sensor, 1);
    std::fill(frame.range.begin(), frame.range.end(), 0);
    frame.range[frame.at(1, 32)] = 10000;
    const Scan scan = scanOf(*read(captureOf(test::packetsOf(sensor, frame)).bytes()).at(0));
    ASSERT_EQ(scan.size(), 1u);
    EXPECT_NEAR(scan.x_m[0], 10 * std::cos(radians(15.0)), 0.03);
    EXPECT_NEAR(scan.y_m[0], -scan.x_m[0] * std::tan(radians(1.0)), 0.01);
    EXPECT_NEAR(scan.z_m[0], 10 * std::sin(radians(15.0)), 0.01);
}

TEST_F(OusterCaptureTest, FrameIdsWrap) {
    const sensors::OusterSensor sensor = sensorOf("RNG15_RFL8_NIR8");
    const auto packets = packetsOfFrames(sensor, 5, 65533);
    const Scans scans = read(captureOf(packets).bytes());
    ASSERT_EQ(scans.size(), 5u);
    EXPECT_THAT(remarks_[0],
                HasSubstr("ouster (OS-0-32-U1, RNG15_RFL8_NIR8): 20 packets in 5 turns"));
    EXPECT_THAT(remarks_[0], Not(HasSubstr("lost")));
    EXPECT_EQ(remarks_[1], "20 frames; ignored: none");
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(mrpt::Clock::toDouble(scans[i]->timestamp),
                    1700000000 + 0.004 * static_cast<double>(i), 1e-4);
    }
}

TEST_F(OusterCaptureTest, CountsLostDuplicateAndLatePackets) {
    const sensors::OusterSensor sensor = sensorOf("RNG19_RFL8_SIG16_NIR16");
    auto packets = packetsOfFrames(sensor, 6);
    const Scans whole = read(captureOf(packets).bytes());
    // Two packets of a frame are swapped, one is half a turn late, one is duplicated.
    std::swap(packets[0], packets[1]);
    std::rotate(packets.begin() + 5, packets.begin() + 6, packets.begin() + 8);
    packets.insert(packets.begin() + 9, packets[8]);
    Scans mixed = read(captureOf(packets).bytes());
    ASSERT_EQ(mixed.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(scanOf(*mixed[i]).x_m, scanOf(*whole[i]).x_m);
    }
    EXPECT_THAT(remarks_[0], HasSubstr(", 16 duplicate columns dropped"));
    EXPECT_THAT(remarks_[0], Not(HasSubstr("missing")));

    packets = packetsOfFrames(sensor, 6);
    const std::string late = packets[0];
    packets.erase(packets.begin() + 12, packets.begin() + 20);  // two frames
    packets.erase(packets.begin() + 5);
    packets.push_back(late);
    mixed = read(captureOf(packets).bytes());
    EXPECT_EQ(mixed.size(), 4u);
    EXPECT_THAT(remarks_[0],
                HasSubstr("2 turns lost, 16 columns missing, 1 packet more than a turn"));
}

TEST_F(OusterCaptureTest, RestartLosesNoPackets) {
    const sensors::OusterSensor sensor = sensorOf("RNG19_RFL8_SIG16_NIR16");
    auto packets = packetsOfFrames(sensor, 3, 5000);
    const auto again = packetsOfFrames(sensor, 3, 0);
    packets.insert(packets.end(), again.begin(), again.end());
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 6u);
    EXPECT_THAT(remarks_[0], Not(HasSubstr("dropped")));
    EXPECT_THAT(remarks_[0], Not(HasSubstr("lost")));
}

/// A restarted sensor may repeat recent frame IDs: many consecutive late packets mean a restart.
TEST_F(OusterCaptureTest, EarlyRestartLosesSixteenPackets) {
    const sensors::OusterSensor sensor = sensorOf("RNG19_RFL8_SIG16_NIR16");
    auto packets = packetsOfFrames(sensor, 20, 300);
    const auto again = packetsOfFrames(sensor, 30, 0);
    packets.insert(packets.end(), again.begin(), again.end());
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 46u);  // frames of four packets
    EXPECT_THAT(remarks_[0], HasSubstr("16 packets more than a turn late, dropped"));
    EXPECT_THAT(remarks_[0], Not(HasSubstr("lost")));
}

TEST_F(OusterCaptureTest, CountsIgnoredDatagrams) {
    const sensors::OusterSensor sensor = sensorOf("RNG19_RFL8_SIG16_NIR16");
    auto packets = packetsOfFrames(sensor, 1);
    packets.push_back(std::string(48, '\0'));
    packets.push_back("hello");
    std::string other = packets[0];
    other[7] = static_cast<char>(other[7] ^ 1);
    packets.push_back(other);
    std::string bad_number = packets[1];
    bad_number[32 + 9] = '\x7f';
    packets[1] = bad_number;
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 1u);
    EXPECT_THAT(remarks_[0],
                HasSubstr("1 column missing, 1 column with an invalid number, dropped"));
    EXPECT_EQ(remarks_[1],
              "7 frames; ignored: 1 IMU packet, 1 packet from another sensor (serial "
              "number 992137000143), 1 other UDP datagram (most: 1 of 5 bytes to port 7502)");
}

TEST_F(OusterCaptureTest, ReportsMetadataFromOtherSensor) {
    const sensors::OusterSensor sensor = sensorOf("RNG19_RFL8_SIG16_NIR16");
    const std::string bytes = captureOf(packetsOfFrames(sensor, 2)).bytes();
    json_ = folder_.write("other.json", test::ousterJson("RNG19_RFL8_SIG16_NIR16", "123"));
    EXPECT_TRUE(read(bytes).empty());
    EXPECT_THAT(broken_,
                HasSubstr("a.pcap: has no packets from the OS-0-32-U1 with serial number 123 in "));
    EXPECT_THAT(broken_, HasSubstr("8 packets from another sensor (serial number 992137000142)"));
    json_ = folder_.write("other.json", test::ousterJson("RNG15_RFL8_NIR8"));
    EXPECT_TRUE(read(bytes).empty());
    EXPECT_THAT(broken_,
                HasSubstr("(512 bytes, profile RNG15_RFL8_NIR8); it has 8 other UDP datagrams "
                          "(most: 8 of 1024 bytes to port 7502). Is it another"));
}

TEST_F(OusterCaptureTest, DropsTurnsInOtherMode) {
    test::TurningOuster ouster;
    std::vector<std::string> packets;
    const auto add = [&](const test::OusterMode& mode, int turns) {
        for (int k = 0; k < turns; ++k) {
            const auto turn = ouster.turn(mode);
            packets.insert(packets.end(), turn.begin(), turn.end());
        }
    };
    add({1024, 10}, 3);
    json_ = folder_.write("sensor.json", test::ousterJsonOf({1024, 10}));
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 3u);
    EXPECT_THAT(remarks_[0], Not(HasSubstr("dropped")));
    add({2048, 10}, 2);
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 3u);
    EXPECT_THAT(remarks_[0],
                HasSubstr("2 turns dropped, because columns may not match the metadata"));
    json_ = folder_.write("other.json", test::ousterJsonOf({512, 10}));
    EXPECT_EQ(read(captureOf(packets).bytes()).size(), 0u);
    EXPECT_THAT(broken_, HasSubstr("a.pcap: its turns do not have the 512 columns in "));
}

TEST_F(OusterCaptureTest, ReadsTruncatedCapture) {
    const sensors::OusterSensor sensor = sensorOf("RNG15_RFL8_NIR8");
    const auto packets = packetsOfFrames(sensor, 4);
    const std::string whole = captureOf(packets).bytes();
    std::size_t max = 0;
    for (std::size_t cut = 1; cut <= 50; ++cut) {
        const std::size_t size = whole.size() * cut / 51;
        const Scans scans = read(whole.substr(0, size));
        EXPECT_THAT(broken_, HasSubstr("a.pcap: ")) << size;
        EXPECT_GE(scans.size(), max);
        max = scans.size();
    }
    EXPECT_EQ(max, 4u);
}

TEST_F(OusterCaptureTest, SurvivesCorruptData) {
    test::Random random(5);
    for (const std::string profile : kProfiles) {
        const sensors::OusterSensor sensor = sensorOf(profile);
        const auto packets = packetsOfFrames(sensor, 3);
        for (int round = 0; round < 20; ++round) {
            auto damaged = packets;
            for (int i = random.whole(1, 20); i > 0; --i) {
                std::string& packet = damaged[static_cast<std::size_t>(random.whole(0, 11))];
                packet[static_cast<std::size_t>(random.whole(0, 60))] =
                    static_cast<char>(random.whole(0, 255));
            }
            for (const auto& scan : read(captureOf(damaged).bytes())) scanOf(*scan);
        }
    }
}

/// The MD5 sum of these numbers, computed by md5sum.
template <class Number>
std::string md5Of(const std::vector<Number>& numbers, const test::TemporaryFolder& folder) {
    const auto file = test::writeBytes(folder / "numbers", test::raw(numbers));
    const auto outcome = test::run("/usr/bin/md5sum", {file.string()});
    return outcome.out.substr(0, 32);
}

TEST_F(OusterCaptureTest, MatchesRealCaptureDigests) {
    const auto folder = test::dataFolder("HAGEN_OUSTER_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_OUSTER_DATA is not a folder of captures";
    const sensors::OusterSensor sensor =
        sensors::readOusterSensor(folder / "OS-0-32-U1_v2.2.0_1024x10.json");
    sensors::CaptureFile capture(folder / "OS-0-32-U1_v2.2.0_1024x10.pcap");
    sensors::OusterFrames frames(sensor);
    sensors::Datagram datagram;
    while (capture.next(datagram)) {
        if (datagram.size == sensor.packetBytes()) frames.add(datagram.bytes, datagram.time_ns);
    }
    frames.finish();
    ASSERT_EQ(frames.complete().size(), 1u);
    const sensors::OusterFrame& frame = frames.complete().front();
    EXPECT_EQ(frame.id, 1453);
    const std::string digests = test::readFile(folder / "OS-0-32-U1_v2.2.0_1024x10_digest.json");
    const std::string of_scan = digests.substr(digests.find("\"scans\""));
    EXPECT_THAT(of_scan, HasSubstr("\"RANGE\": \"" + md5Of(frame.range, folder_)));
    EXPECT_THAT(of_scan, HasSubstr("\"RANGE2\": \"" + md5Of(frame.second_range, folder_)));
    EXPECT_THAT(of_scan, HasSubstr("\"REFLECTIVITY\": \"" + md5Of(frame.reflectivity, folder_)));
    EXPECT_THAT(of_scan,
                HasSubstr("\"REFLECTIVITY2\": \"" + md5Of(frame.second_reflectivity, folder_)));
    EXPECT_THAT(of_scan, HasSubstr("\"TIMESTAMP\": \"" + md5Of(frame.column_time_ns, folder_)));
    EXPECT_EQ(frames.counts().missing_columns, 0u);
}

TEST_F(OusterCaptureTest, ReadsRealCapture) {
    const auto folder = test::dataFolder("HAGEN_OUSTER_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_OUSTER_DATA is not a folder of captures";
    const auto capture = sensors::openCapture(folder / "OS-1-128_v2.3.0_1024x10_lb_n3.pcap",
                                              folder / "OS-1-128_v2.3.0_1024x10.json");
    for (int i = 0; i < 3; ++i) {
        const auto sweep = capture->nextSweep();
        ASSERT_TRUE(sweep);
        const auto observed = observedOf(*observationOf(*sweep));
        EXPECT_EQ(observed.sensor.rows(), 128);
        EXPECT_GT(observed.scan.size(), 30000u);
        EXPECT_NEAR(observed.scan.time_s.back(), 0.1, 0.01);
        // Returns lie on their beams, except for the offset of the origin.
        for (std::size_t k = 0; k < observed.scan.size(); ++k) {
            const float elevation_rad = std::asin(observed.scan.z_m[k] / observed.scan.range_m[k]);
            const float of_beam_rad = observed.sensor.elevations_rad[observed.scan.row[k]];
            ASSERT_LT(std::abs(elevation_rad - of_beam_rad),
                      0.02f / observed.scan.range_m[k] + 1e-4f);
        }
    }
    EXPECT_FALSE(capture->nextSweep());
    EXPECT_THAT(capture->remarks()[0], HasSubstr("192 packets in 3 turns"));
    EXPECT_THAT(capture->remarks()[1], HasSubstr("222 frames; ignored: 30 IMU packets"));
}

}  // namespace
}  // namespace hagen::recordings
