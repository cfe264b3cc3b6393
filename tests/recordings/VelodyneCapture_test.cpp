#include <hagen/mrpt/VelodyneObservation.h>

#include <algorithm>
#include <cmath>

#include "support/CaptureTest.h"
#include "support/Captures.h"
#include "support/Hdl64.h"
#include "support/Random.h"
#include "support/SimpleFirings.h"

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using observations::decodePackets;
using sensors::velodyneModel;
using test::ByteString;
using test::CaptureWriter;
using test::SentDatagram;
using testing::HasSubstr;
using testing::Not;

using Packets = std::vector<ByteString>;
using Turns = std::vector<CObservationVelodyneScan::Ptr>;

/// Packets of a sensor that turns at 10 Hz, starting at this azimuth.
Packets packetsOf(const std::string& model_name, int firings, double first_azimuth_deg = 0,
                  std::uint32_t first_time_us = 1000000, bool is_dual = false) {
    const sensors::VelodyneModel& model = sensors::velodyneModel(model_name);
    test::Random random(static_cast<unsigned>(firings));
    observations::Firings all;
    all.range_m = random.image(model.lasers, firings, 1.0f, 50.0f, 0.1);
    all.intensity = random.image(model.lasers, firings, 0.0f, 1.0f, 0.0);
    if (is_dual) all.last_range_m = all.range_m;
    all.first_azimuth_deg = first_azimuth_deg;
    all.azimuth_step_deg = 360.0 * model.firing_period_us / 100e3;
    all.first_time_us = first_time_us;
    return test::packetsOf(model, all);
}

double azimuthDegOf(const ByteString& packet) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(packet[i]); };
    return 0.01 * (at(2) + 256 * at(3));
}

Packets packetsOf(const Turns& turns) {
    Packets packets;
    for (const auto& turn : turns) {
        for (const auto& packet : turn->scan_packets) packets.push_back(test::bytesOf(packet));
    }
    return packets;
}

class VelodyneCaptureTest : public test::CaptureTest {
 protected:
    static SentDatagram sent(const ByteString& packet) { return {packet}; }
    static CaptureWriter captureOf(const Packets& packets) {
        return CaptureWriter().datagrams(packets);
    }
    Turns read(const ByteString& bytes) {
        return readFile(test::writeBytes(folder_ / "a.pcap", bytes));
    }
    Turns readFile(const std::filesystem::path& file) {
        Turns turns;
        for (const auto& scan : CaptureTest::readFile(file)) {
            turns.push_back(std::dynamic_pointer_cast<CObservationVelodyneScan>(scan));
        }
        return turns;
    }
};

TEST_F(VelodyneCaptureTest, TurnEndsWhereAzimuthWraps) {
    for (const std::string model : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"}) {
        SCOPED_TRACE(model);
        const double period_us = sensors::velodyneModel(model).firing_period_us;
        const Packets packets = packetsOf(model, static_cast<int>(310e3 / period_us), 200.0);
        const Turns turns = read(captureOf(packets).bytes());
        ASSERT_EQ(turns.size(), 4u);  // 160 degrees, two whole turns, and the remainder
        EXPECT_EQ(packetsOf(turns), packets);
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const Packets of_turn = packetsOf({turns[i]});
            EXPECT_TRUE(std::is_sorted(of_turn.begin(), of_turn.end(),
                                       [](const ByteString& a, const ByteString& b) {
                                           return azimuthDegOf(a) < azimuthDegOf(b);
                                       }));
            EXPECT_EQ(turns[i]->sensorLabel, "velodyne");
            Scan scan;
            EXPECT_EQ(decodePackets(*turns[i], scan), 0u);
            EXPECT_EQ(observations::sensorOf(*turns[i]).name, model);
            EXPECT_GT(scan.time_s.back(), 0.0f);
            EXPECT_LT(scan.time_s.back(), 0.102f);
        }
        EXPECT_EQ(broken_, "");
        EXPECT_EQ(remarks_[0], "velodyne (" + model + " at 10.0.0.100, port 2368): " +
                                   std::to_string(packets.size()) + " packets in 4 turns");
        EXPECT_THAT(remarks_[1], HasSubstr("; ignored: none"));
    }
}

TEST_F(VelodyneCaptureTest, TurnHasTimeAndRangeLimits) {
    const Turns turns = read(captureOf(packetsOf("VLP-16", 24 * 100, 0.0)).bytes());
    ASSERT_EQ(turns.size(), 2u);
    EXPECT_NEAR(mrpt::Clock::toDouble(turns[0]->timestamp), 1700000000.0, 1e-6);
    EXPECT_NEAR(mrpt::Clock::toDouble(turns[1]->timestamp),
                1700000000.0 + 0.001 * static_cast<double>(turns[0]->scan_packets.size()), 1e-4);
    EXPECT_EQ(turns[0]->minRange, 0.5);
    EXPECT_EQ(turns[0]->maxRange, 120.0);
}

TEST_F(VelodyneCaptureTest, CountsLostPackets) {
    Packets packets = packetsOf("VLP-16", 24 * 200);
    packets.erase(packets.begin() + 50);
    packets.erase(packets.begin() + 120, packets.begin() + 127);
    EXPECT_EQ(packetsOf(read(captureOf(packets).bytes())), packets);
    EXPECT_THAT(remarks_[0], HasSubstr(", 8 packets lost"));
}

TEST_F(VelodyneCaptureTest, LostTurnDoesNotJoinNeighbours) {
    Packets packets = packetsOf("VLP-16", 24 * 200);  // 75.4 packets per turn
    packets.erase(packets.begin() + 10, packets.begin() + 110);
    const Turns turns = read(captureOf(packets).bytes());
    ASSERT_EQ(turns.size(), 3u);
    EXPECT_EQ(turns[0]->scan_packets.size(), 10u);
    EXPECT_THAT(remarks_[0], HasSubstr(", 100 packets lost"));
}

TEST_F(VelodyneCaptureTest, SilentSectorKeepsSweepsWhole) {
    constexpr int kSweeps = 5;
    const sensors::VelodyneModel& model = velodyneModel("VLP-16");
    test::Random random(7);
    for (int trial = 0; trial < 60; ++trial) {
        const double turn_us = 1e6 / random.whole(5, 20);
        const double from_deg = 0.1 * random.whole(0, 3599);
        const double width_deg = random.whole(10, 350);
        SCOPED_TRACE(testing::Message() << turn_us << " us, silent from " << from_deg << " over "
                                        << width_deg << " degrees");
        observations::Firings all;
        const int firings = static_cast<int>(kSweeps * turn_us / model.firing_period_us) / 24 * 24;
        all.range_m = random.image(model.lasers, firings, 1.0f, 50.0f, 0.1);
        all.intensity.setZero(model.lasers, firings);
        all.azimuth_step_deg = 360.0 * model.firing_period_us / turn_us;
        const Packets packets = test::packetsOf(model, all);
        const Packets sent = test::withSilentSector(packets, from_deg, width_deg);
        const Turns turns = read(captureOf(sent).bytes());
        EXPECT_EQ(turns.size(), std::size_t{kSweeps});
        EXPECT_EQ(packetsOf(turns), sent);
        EXPECT_THAT(remarks_[0], Not(HasSubstr("lost")));
    }
}

TEST_F(VelodyneCaptureTest, SilentSectorHidesNoLoss) {
    Packets packets = test::withSilentSector(packetsOf("VLP-16", 24 * 400), 90, 180);
    packets.erase(packets.begin() + 80, packets.begin() + 83);
    packets.erase(packets.begin() + 20);
    read(captureOf(packets).bytes());
    EXPECT_THAT(remarks_[0], HasSubstr(", 4 packets lost"));
}

TEST_F(VelodyneCaptureTest, ReordersPackets) {
    const Packets packets = packetsOf("VLP-16", 24 * 200);
    Packets mixed = packets;
    std::swap(mixed[20], mixed[21]);
    std::rotate(mixed.begin() + 70, mixed.begin() + 71, mixed.begin() + 82);  // across a wrap
    const Turns turns = read(captureOf(mixed).bytes());
    EXPECT_EQ(packetsOf(turns), packets);
    EXPECT_EQ(turns.size(), 3u);
    EXPECT_THAT(remarks_[0], HasSubstr(", 2 packets reordered"));
}

TEST_F(VelodyneCaptureTest, DropsDuplicates) {
    const Packets packets = packetsOf("HDL-32E", 12 * 100);
    Packets doubled;
    for (const ByteString& packet : packets) doubled.insert(doubled.end(), 2, packet);
    EXPECT_EQ(packetsOf(read(captureOf(doubled).bytes())), packets);
    EXPECT_THAT(remarks_[0], HasSubstr(", 100 duplicate packets dropped"));
}

/// A slower path duplicates every tenth packet 30 ms later; one packet arrives only there.
TEST_F(VelodyneCaptureTest, DropsPacketsFarTooLate) {
    const Packets packets = packetsOf("VLP-16", 24 * 200);
    Packets with_copies, without_one;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        if (i != 100) {
            with_copies.push_back(packets[i]);
            without_one.push_back(packets[i]);
        }
        if (i >= 23 && i % 10 == 0) with_copies.push_back(packets[i - 23]);
        if (i == 123) with_copies.push_back(packets[100]);
    }
    const Turns turns = read(captureOf(with_copies).bytes());
    EXPECT_EQ(packetsOf(turns), without_one);
    EXPECT_EQ(turns.size(), 3u);
    EXPECT_THAT(remarks_[0], HasSubstr(", 1 packet lost"));
    EXPECT_THAT(remarks_[0], HasSubstr(", 18 packets more than 16 packets late, dropped"));
    EXPECT_EQ(remarks_[0].find("interruption"), std::string::npos) << remarks_[0];
}

/// The clock steps back by slightly more than 16 packets, so new packets look like late ones.
TEST_F(VelodyneCaptureTest, SmallClockStepBackLosesNoPackets) {
    for (const std::uint32_t back_us : {23000u, 30000u, 42000u}) {
        Packets packets = packetsOf("VLP-16", 24 * 100, 0.0, 900000000u);
        const auto end_us = static_cast<std::uint32_t>(900000000 + 100 * 1327);
        const Packets later = packetsOf("VLP-16", 24 * 90, 100.0, end_us - back_us);
        packets.insert(packets.end(), later.begin(), later.end());
        EXPECT_EQ(packetsOf(read(captureOf(packets).bytes())), packets) << back_us;
        EXPECT_THAT(remarks_[0], HasSubstr(", 1 interruption (gap or clock jump)")) << back_us;
    }
}

/// A few packets after a clock step are sufficient.
TEST_F(VelodyneCaptureTest, ClockStepBeforeEndLosesNoPackets) {
    Packets packets = packetsOf("VLP-16", 24 * 40, 0.0, 900000000u);
    for (const std::uint32_t time_us : {100000000u, 50000000u}) {
        const Packets later = packetsOf("VLP-16", 24 * 5, 200.0, time_us);
        packets.insert(packets.end(), later.begin(), later.end());
    }
    EXPECT_EQ(packetsOf(read(captureOf(packets).bytes())), packets);
    EXPECT_THAT(remarks_[0], HasSubstr(", 2 interruptions (gap or clock jump)"));
}

TEST_F(VelodyneCaptureTest, ClockWrapIsNotInterruption) {
    const Packets packets = packetsOf("VLP-16", 24 * 40, 0.0, 3599980000u);
    const Turns turns = read(captureOf(packets).bytes());
    ASSERT_EQ(turns.size(), 1u);
    EXPECT_EQ(packetsOf(turns), packets);
    EXPECT_EQ(remarks_[0].find("lost"), std::string::npos) << remarks_[0];
    EXPECT_EQ(remarks_[0].find("interruption"), std::string::npos) << remarks_[0];
}

TEST_F(VelodyneCaptureTest, ClockStepEndsTurn) {
    Packets packets = packetsOf("VLP-16", 24 * 40, 0.0, 900000000u);
    const Packets later = packetsOf("VLP-16", 24 * 30, 200.0, 100000000u);
    packets.insert(packets.end(), later.begin(), later.end());
    const Packets even_later = packetsOf("VLP-16", 24 * 20, 340.0, 200000000u);
    packets.insert(packets.end(), even_later.begin(), even_later.end());
    const Turns turns = read(captureOf(packets).bytes());
    EXPECT_EQ(packetsOf(turns), packets);
    ASSERT_GE(turns.size(), 3u);
    EXPECT_EQ(turns[0]->scan_packets.size(), 40u);
    EXPECT_EQ(turns[1]->scan_packets.size(), 30u);
    EXPECT_THAT(remarks_[0], HasSubstr(", 2 interruptions (gap or clock jump)"));
}

TEST_F(VelodyneCaptureTest, StalledSensorHasBoundedScans) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    observations::Firings firings;
    firings.range_m.setConstant(16, 24 * 1000, 5.0f);
    firings.intensity.setZero(16, 24 * 1000);
    firings.azimuth_step_deg = 0;
    const Packets packets = test::packetsOf(model, firings);
    const Turns turns = read(captureOf(packets).bytes());
    EXPECT_EQ(packetsOf(turns), packets);
    for (const auto& turn : turns) EXPECT_LE(turn->scan_packets.size(), 190u);
}

TEST_F(VelodyneCaptureTest, ReadsDualReturns) {
    const Packets packets = packetsOf("VLP-16", 24 * 100, 0.0, 0, true);
    const Turns turns = read(captureOf(packets).bytes());
    EXPECT_EQ(packetsOf(turns), packets);
    EXPECT_EQ(turns.size(), 2u);
    EXPECT_THAT(remarks_[0],
                HasSubstr(", " + std::to_string(packets.size()) + " packets with dual returns"));
    EXPECT_EQ(remarks_[0].find("lost"), std::string::npos);
}

TEST_F(VelodyneCaptureTest, SeparatesSensors) {
    const Packets front = packetsOf("VLP-16", 24 * 20), rear = packetsOf("VLP-16", 24 * 30),
                  top = packetsOf("HDL-32E", 12 * 40);
    CaptureWriter writer;
    for (std::size_t i = 0; i < 40; ++i) {
        if (i < 20) writer.datagram(sent(front[i]));
        SentDatagram other = sent(i < 30 ? rear[i] : "");
        other.to_port = 2369;
        if (i < 30) writer.datagram(other);
        other = sent(top[i]);
        other.from_ip = 0x0a000065;
        writer.datagram(other);
    }
    const Turns turns = read(writer.bytes());
    ASSERT_EQ(turns.size(), 3u);
    EXPECT_EQ(turns[0]->sensorLabel, "velodyne");
    EXPECT_EQ(packetsOf({turns[0]}), front);
    EXPECT_EQ(turns[1]->sensorLabel, "velodyne_2");
    EXPECT_EQ(packetsOf({turns[1]}), rear);
    EXPECT_EQ(turns[2]->sensorLabel, "velodyne_3");
    EXPECT_EQ(packetsOf({turns[2]}), top);
    EXPECT_THAT(remarks_[2],
                HasSubstr("velodyne_3 (HDL-32E at 10.0.0.101, port 2368): 40 packets"));
}

TEST_F(VelodyneCaptureTest, CountsIgnoredDatagrams) {
    CaptureWriter writer = captureOf(packetsOf("VLP-16", 24 * 5));
    SentDatagram position = sent(ByteString(512, '\0'));
    position.to_port = 8308;
    writer.datagram(position).datagram(position);
    SentDatagram ouster = sent(ByteString(8448, '\0'));
    ouster.to_port = 7502;
    writer.datagram(ouster);
    ByteString other_model = packetsOf("VLP-16", 24)[0];
    other_model[1205] = '\x63';
    writer.datagram(sent(other_model));
    ByteString hdl64 = packetsOf("VLP-16", 24)[0];
    for (std::size_t block = 1; block < 12; block += 2) hdl64[100 * block + 1] = '\xdd';
    writer.datagram(sent(hdl64)).datagram(sent(hdl64));
    writer.frame("arp");
    EXPECT_EQ(read(writer.bytes()).size(), 1u);
    EXPECT_EQ(remarks_[1],
              "12 frames; ignored: 2 position packets (GPS), 2 packets from an HDL-64E (unreadable "
              "without --calibration FILE), 1 packet from an unsupported sensor (VLS-128 "
              "prototype, model id 0x63), 1 other UDP datagram "
              "(most: 1 of 8448 bytes to port 7502), 1 frame of other traffic");
}

TEST_F(VelodyneCaptureTest, NamesUnsupportedSensors) {
    const auto starting = [](const std::string& start, std::size_t size) {
        return sent(start + ByteString(size - start.size(), '\0'));
    };
    SentDatagram livox = starting("\x05\x01", 1362);
    livox.content[9] = 2;
    SentDatagram leishen = starting("\xff\xee", 1212),
                 leishen_16 = sent(packetsOf("VLP-16", 24)[0]);
    leishen.content.replace(100, 2, "\xff\xee");
    leishen_16.content[1205] = '\x10';
    CaptureWriter writer;
    for (const auto& datagram : {starting("\x55\xaa\x05\x0a\x5a\xa5\x50\xa0", 1248),
                                 starting("\x55\xaa\x05\x5a", 1248), livox, leishen, leishen_16}) {
        writer.datagram(datagram);
    }
    EXPECT_TRUE(read(writer.bytes()).empty());
    EXPECT_THAT(broken_,
                HasSubstr("it has 1 packet from an unsupported sensor (Leishen C16, model id "
                          "0x10), 1 packet from a Leishen (not supported), 1 packet from a "
                          "Livox with SDK 1 (not supported), 2 packets from a RoboSense"));
    EXPECT_THAT(broken_, Not(HasSubstr("Ouster")));
    // Similar datagrams of other senders.
    livox.content[9] = 3;
    leishen.content[100] = '\0';
    read(CaptureWriter().datagram(livox).datagram(leishen).bytes());
    EXPECT_THAT(broken_, HasSubstr("it has 2 other UDP datagrams"));
}

TEST_F(VelodyneCaptureTest, LimitsNumberOfSensors) {
    CaptureWriter writer;
    const ByteString packet = packetsOf("VLP-16", 24)[0];
    for (std::uint32_t i = 0; i < 100; ++i) {
        SentDatagram datagram = sent(packet);
        datagram.from_ip = i;
        writer.datagram(datagram);
    }
    EXPECT_EQ(read(writer.bytes()).size(), 16u);
    EXPECT_THAT(remarks_.back(), HasSubstr("84 packets from further sensors"));
}

TEST_F(VelodyneCaptureTest, ReportsCaptureWithoutPackets) {
    SentDatagram ouster = sent(ByteString(8448, '\0'));
    ouster.to_port = 7502;
    EXPECT_TRUE(read(CaptureWriter().datagram(ouster).datagram(ouster).bytes()).empty());
    EXPECT_THAT(broken_,
                HasSubstr("a.pcap: has no data packets from a known Velodyne (VLP-16 (0x22)"));
    EXPECT_THAT(broken_, HasSubstr("2 other UDP datagrams (most: 2 of 8448 bytes to port 7502)"));
    EXPECT_THAT(broken_, HasSubstr("--sensor-json FILE"));
    EXPECT_TRUE(read(CaptureWriter().bytes()).empty());
    EXPECT_THAT(broken_, HasSubstr("no frames"));
}

TEST_F(VelodyneCaptureTest, ReadsTruncatedCapture) {
    const Packets packets = packetsOf("VLP-16", 24 * 90);
    const ByteString whole = captureOf(packets).bytes();
    const std::size_t frame = (whole.size() - 24) / packets.size();
    for (std::size_t cut = 1; cut <= 60; ++cut) {
        const std::size_t size = whole.size() * cut / 61;
        const Packets before(packets.begin(),
                             packets.begin() + static_cast<std::ptrdiff_t>((size - 24) / frame));
        EXPECT_EQ(packetsOf(read(whole.substr(0, size))), before);
        if ((size - 24) % frame == 0) continue;  // equals a shorter capture
        EXPECT_THAT(broken_, HasSubstr("a.pcap: frame " + std::to_string(before.size()) +
                                       " at byte " + std::to_string(24 + before.size() * frame)));
    }
}

TEST_F(VelodyneCaptureTest, ReadsRealCaptures) {
    const auto folder = test::dataFolder("HAGEN_VELODYNE_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_VELODYNE_DATA is not a folder of captures";
    for (const auto& [file, calibration, count] :
         {std::tuple{"sample_velodyne_vlp16_gps.pcap", "VLP16", 5u},
          {"sample_velodyne_hdl32.pcap", "HDL32", 4u}}) {
        SCOPED_TRACE(file);
        const auto expected = test::readCapture(folder / file, calibration);
        const Turns turns = readFile(folder / file);
        EXPECT_EQ(broken_, "");
        EXPECT_EQ(turns.size(), count);
        EXPECT_EQ(packetsOf(turns), packetsOf({expected}));
        // A scan is shorter than a whole turn plus one packet.
        for (const auto& turn : turns) {
            Scan scan;
            EXPECT_EQ(decodePackets(*turn, scan), 0u);
            EXPECT_LT(scan.time_s.back(), 0.112f);  // a turn at 9 Hz plus one packet
        }
        EXPECT_EQ(remarks_[0].find("lost"), std::string::npos) << remarks_[0];
    }
}

TEST_F(VelodyneCaptureTest, MatchesMrpt) {
    const auto folder = test::dataFolder("HAGEN_VELODYNE_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_VELODYNE_DATA is not a folder of captures";
    // MRPT decodes the first half of each block, i.e. half of the lasers of an HDL-32E.
    for (const auto& turn : readFile(folder / "sample_velodyne_vlp16_gps.pcap")) {
        turn->minRange = 0;
        turn->maxRange = 1000;
        Scan scan;
        decodePackets(*turn, scan);
        const auto packets = turn->scan_packets.size();
        CObservationVelodyneScan::TGeneratePointCloudParameters all;
        all.filterOutIsolatedPoints = false;
        turn->generatePointCloud(all);
        EXPECT_GT(turn->point_cloud.size(), packets * 10);
        std::size_t next = 0;  // MRPT's returns are a subset of ours in the same order
        for (std::size_t i = 0; i < turn->point_cloud.size(); ++i) {
            const auto& cloud = turn->point_cloud;
            while (next < scan.size() &&
                   std::hypot(scan.x_m[next] - cloud.x[i], scan.y_m[next] - cloud.y[i],
                              scan.z_m[next] - cloud.z[i]) > 0.01f) {
                ++next;
            }
            ASSERT_LT(next, scan.size()) << "MRPT's return " << i;
            ++next;
        }
    }
}

TEST_F(VelodyneCaptureTest, ReadsRawPackets) {
    const auto folder = test::dataFolder("HAGEN_VELODYNE_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_VELODYNE_DATA is not a folder of captures";
    const ByteString raw = test::readFile(folder / "vlp16_packets_1206.bin");
    Packets packets;
    for (std::size_t at = 0; at + 1206 <= raw.size(); at += 1206)
        packets.push_back(raw.substr(at, 1206));
    ASSERT_EQ(packets.size(), 1000u);
    const Turns turns = read(captureOf(packets).bytes());
    EXPECT_EQ(packetsOf(turns), packets);
    EXPECT_EQ(turns.size(), 14u);  // 12 of them are whole turns
}

/// A capture of an HDL-64E with all returns at 5 m.
CaptureWriter hdl64Capture(int firings) {
    return CaptureWriter().datagrams(test::hdl64Packets(firings, [](int, double) { return 5.0; }),
                                     288e-6);
}

TEST_F(VelodyneCaptureTest, Hdl64NeedsCalibration) {
    const auto file = hdl64Capture(4200).write(folder_ / "hdl64.pcap");
    const auto xml = test::writeBytes(folder_ / "db.xml", test::hdl64Xml());
    const auto capture = sensors::openCapture(file, {}, xml);
    std::size_t returns = 0, turns = 0;
    while (const auto turn = capture->nextSweep()) {
        Scan scan;
        const auto observation = observationOf(*turn);
        EXPECT_EQ(decodePackets(dynamic_cast<CObservationVelodyneScan&>(*observation), scan), 0u);
        returns += scan.size();
        ++turns;
    }
    EXPECT_EQ(turns, 3u);
    EXPECT_EQ(returns, 64u * 4200);
    EXPECT_THAT(capture->remarks()[0], HasSubstr("HDL-64E at 10.0.0.100"));
    EXPECT_THAT(capture->remarks()[0], HasSubstr("700 packets in 3 turns"));
    EXPECT_THAT(capture->remarks()[0], Not(HasSubstr("lost")));

    EXPECT_THAT(test::messageOf([&] { sensors::openCapture(file)->nextSweep(); }),
                HasSubstr("--calibration FILE"));
    const auto other = captureOf(packetsOf("VLP-16", 48)).write(folder_ / "vlp16.pcap");
    const auto without_hdl64 = sensors::openCapture(other, {}, xml);
    while (without_hdl64->nextSweep()) {
    }
    EXPECT_THAT(without_hdl64->remarks()[1], HasSubstr("db.xml is not used"));
    EXPECT_THROW(sensors::openCapture(file, {}, file), std::runtime_error);
}

}  // namespace
}  // namespace hagen::recordings
