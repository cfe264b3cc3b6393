#include <hagen/mrpt/LocatedCloud.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <chrono>

#include "support/CaptureTest.h"
#include "support/LivoxPackets.h"
#include "support/Random.h"

namespace hagen::recordings {
namespace {

using test::CaptureWriter;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

using Point = test::LivoxPoint;

class LivoxCaptureTest : public test::CaptureTest {
 protected:
    static CaptureWriter captureOf(const std::vector<std::string>& packets) {
        return CaptureWriter().datagrams(packets, 480e-6, 56301);
    }
    /// `count` packets of 480 us with one point each, whose x is the packet's number.
    static std::vector<std::string> packets(int count, std::int64_t first_ns = 5000) {
        std::vector<std::string> all;
        for (int i = 0; i < count; ++i) {
            all.push_back(
                test::livoxPacket({{1000 + i, 0, 500, 255}}, first_ns + 480000 * i, i & 0xffff));
        }
        return all;
    }
};

TEST_F(LivoxCaptureTest, ReadsLivoxViewerLikePackets) {
    std::vector<std::string> all;
    for (int i = 0; i < 500; ++i) {
        all.push_back(test::livoxPacketOfWall(i, 1700000000000000000 + i * test::kLivoxPacket_ns));
    }
    all.push_back(test::livoxPacket({{100, 200, 300, 7}}, 1700000000000000000 + 250000000, 500, 2));
    const std::string lvx2 = test::lvx2Of(all);
    const auto turnsOf = [&](const std::string& bytes) {
        std::vector<std::vector<float>> turns;
        for (const auto& scan : read(bytes)) {
            const auto observed = observedOf(*scan);
            turns.push_back(observed.scan.x_m);
            const auto& more = observed.scan;
            for (const auto* const column : {&more.y_m, &more.z_m, &more.intensity, &more.time_s}) {
                turns.push_back(*column);
            }
        }
        return turns;
    };
    const auto turns = turnsOf(lvx2);
    EXPECT_EQ(turns.size(), 5 * 3u);
    EXPECT_EQ(turns, turnsOf(captureOf(all).bytes()));
    EXPECT_TRUE(sensors::isCapture(test::writeBytes(folder_ / "a", lvx2)));
    read(lvx2);
    EXPECT_THAT(remarks_, testing::Contains(HasSubstr("at 192.168.1.12): 501 packets in 3 scans")));
    for (const std::size_t size : {lvx2.size() - 1, lvx2.size() / 2}) {
        read(lvx2.substr(0, size));
        EXPECT_THAT(broken_, HasSubstr("truncated?"));
    }
}

TEST_F(LivoxCaptureTest, LimitsSearchForSensorKind) {
    const auto file = CaptureWriter().write(folder_ / "a.pcap");
    std::filesystem::resize_file(file, std::uint64_t{8} << 30);  // sparse; zeros are empty frames
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(sensors::openCapture(file));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    struct Ended {};
    int calls = 0;
    const auto check = [&] {
        if (++calls > 2) throw Ended();
    };
    EXPECT_THROW(sensors::openCapture(file, {}, {}, check), Ended);
    EXPECT_EQ(calls, 3);
}

TEST_F(LivoxCaptureTest, ReadsBothDataTypes) {
    const std::vector<Point> points{{1500, -2500, 250, 51}, {0, 0, 0, 9}, {-3000, 4000, -20, 255}};
    for (const auto& [data_type, unit_m] : {std::pair{1, 0.001f}, {2, 0.01f}}) {
        const Scans scans = read(captureOf({test::livoxPacket(points, 77, 3, data_type)}).bytes());
        ASSERT_EQ(scans.size(), 1u);
        const auto observed = observedOf(*scans[0]);
        EXPECT_EQ(observed.sensor.name, "Mid-360");
        EXPECT_FALSE(observed.sensor.has_rings);
        const Scan& scan = observed.scan;  // omits the point without range
        EXPECT_THAT(scan.x_m,
                    ElementsAre(FloatNear(1500 * unit_m, 1e-4f), FloatNear(-3000 * unit_m, 1e-4f)));
        EXPECT_THAT(scan.y_m,
                    ElementsAre(FloatNear(-2500 * unit_m, 1e-4f), FloatNear(4000 * unit_m, 1e-4f)));
        EXPECT_THAT(scan.z_m,
                    ElementsAre(FloatNear(250 * unit_m, 1e-4f), FloatNear(-20 * unit_m, 1e-4f)));
        EXPECT_THAT(scan.intensity, ElementsAre(0.2f, 1.0f));
        EXPECT_THAT(scan.time_s, ElementsAre(0.0f, FloatNear(320e-6f, 1e-9f)));
        EXPECT_EQ(scan.row.size(), 2u);
    }
}

TEST_F(LivoxCaptureTest, KeepsTags) {
    const std::vector<Point> first{{1000, 0, 0, 1, 16}, {0, 0, 0, 2, 99}, {2000, 0, 0, 3, 255}};
    const auto scans = read(captureOf({test::livoxPacket(first, 0, 0),
                                       test::livoxPacket({{3000, 0, 0, 4, 7}}, 480000, 1, 2),
                                       test::livoxPacket({{4000, 0, 0, 5, 8}}, 100000000, 2)})
                                .bytes());
    ASSERT_EQ(scans.size(), 2u);
    const auto tagsOf = [&](std::size_t scan) {
        const auto& observation =
            dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*scans[scan]);
        const observations::PointTable fields =
            dynamic_cast<const observations::LocatedCloud&>(*observation.pointcloud).otherFields();
        return columnOf(fields, *findField(fields, {"tag"}));
    };
    EXPECT_THAT(tagsOf(0), ElementsAre(16, 255, 7));
    EXPECT_THAT(tagsOf(1), ElementsAre(8));
}

TEST_F(LivoxCaptureTest, CountsImuPackets) {
    std::string imu = test::livoxPacket({}, 0, 0, 0).substr(0, 36) + std::string(24, '\x3f');
    imu[1] = 60;
    std::string other = imu;
    other[10] = 9;
    EXPECT_EQ(read(captureOf({imu, test::livoxPacket({{1000, 0, 0, 1}}, 0, 0), imu, other}).bytes())
                  .size(),
              1u);
    EXPECT_THAT(remarks_.back(),
                HasSubstr("ignored: 2 IMU packets (rates and accelerations, no attitude), 1 other "
                          "UDP datagram"));
}

TEST_F(LivoxCaptureTest, ScansLast100ms) {
    const Scans scans = read(captureOf(packets(500)).bytes());
    ASSERT_EQ(scans.size(), 3u);
    std::size_t points = 0;
    for (const auto& scan : scans) {
        const auto observed = observedOf(*scan);
        EXPECT_LE(observed.scan.size(), 209u);
        EXPECT_EQ(observed.scan.time_s.front(), 0.0f);
        EXPECT_LT(observed.scan.time_s.back(), 0.1f);
        points += observed.scan.size();
        EXPECT_EQ(scan->sensorLabel, "livox");
    }
    EXPECT_EQ(points, 500u);
    EXPECT_NEAR(mrpt::Clock::toDouble(scans[1]->timestamp), 1700000000 + 210 * 480e-6, 1e-3);
    EXPECT_THAT(
        remarks_,
        ElementsAre("livox (Livox, read as a Mid-360, at 10.0.0.100): 500 packets in 3 scans",
                    "500 frames; ignored: none"));
}

TEST_F(LivoxCaptureTest, DropsAndCountsDuplicates) {
    auto all = packets(100);
    all.insert(all.begin() + 40, all[39]);
    std::size_t points = 0;
    for (const auto& scan : read(captureOf(all).bytes())) points += observedOf(*scan).scan.size();
    EXPECT_EQ(points, 100u);
    EXPECT_THAT(remarks_[0], HasSubstr("100 packets in 1 scan, 1 duplicate packet dropped"));
}

TEST_F(LivoxCaptureTest, LateDuplicatesDoNotHideLosses) {
    const auto sent = packets(300);
    auto all = sent;
    all.erase(all.begin() + 50, all.begin() + 53);
    for (const std::size_t i : {20u, 100u, 250u}) all.insert(all.begin() + i + 10, sent[i]);
    std::size_t points = 0;
    for (const auto& scan : read(captureOf(all).bytes())) points += observedOf(*scan).scan.size();
    EXPECT_EQ(points, 297u);
    EXPECT_THAT(remarks_[0], HasSubstr("297 packets"));
    EXPECT_THAT(remarks_[0], HasSubstr("3 packets lost"));
    EXPECT_THAT(remarks_[0], HasSubstr("3 duplicate packets dropped"));
}

TEST_F(LivoxCaptureTest, CountsLossesAndKeepsPoints) {
    auto all = packets(300);
    std::swap(all[20], all[21]);
    all.erase(all.begin() + 50, all.begin() + 53);
    const auto later = packets(10, 9000000000);
    all.insert(all.end(), later.begin(), later.end());
    const auto earlier = packets(10, 1000);
    all.insert(all.end(), earlier.begin(), earlier.end());
    std::size_t points = 0;
    for (const auto& scan : read(captureOf(all).bytes())) points += observedOf(*scan).scan.size();
    EXPECT_EQ(points, 317u);
    EXPECT_THAT(remarks_[0], HasSubstr(", 3 packets lost, 1 packet out of order, kept in the "
                                       "scan in which it arrived, 2 interruptions"));
}

TEST_F(LivoxCaptureTest, CountsOtherDatagrams) {
    auto all = packets(3);
    all.push_back("imu");
    std::string wrong_length = all[0];
    wrong_length.pop_back();
    all.push_back(wrong_length);
    all.push_back(test::livoxPacket({{1, 2, 3, 4}}, 0, 0, 3));  // spherical
    EXPECT_EQ(read(captureOf(all).bytes()).size(), 1u);
    EXPECT_THAT(remarks_[1], HasSubstr("6 frames; ignored: 3 other UDP datagrams"));
}

TEST_F(LivoxCaptureTest, ReadsTruncatedCapture) {
    const std::string whole = captureOf(packets(300)).bytes();
    const std::size_t frame = (whole.size() - 24) / 300;
    for (std::size_t cut = 1; cut <= 50; ++cut) {
        const std::size_t size = whole.size() * cut / 51;
        std::size_t points = 0;
        for (const auto& scan : read(whole.substr(0, size)))
            points += observedOf(*scan).scan.size();
        EXPECT_EQ(points, (size - 24) / frame);
        EXPECT_EQ(broken_.empty(), (size - 24) % frame == 0);
    }
}

TEST_F(LivoxCaptureTest, SurvivesCorruptData) {
    test::Random random(6);
    for (int round = 0; round < 50; ++round) {
        auto all = packets(20);
        for (std::string& packet : all) {
            if (random.chance(0.5)) {
                packet[static_cast<std::size_t>(random.whole(0, 35))] =
                    static_cast<char>(random.whole(0, 255));
            }
        }
        for (const auto& scan : read(captureOf(all).bytes())) observedOf(*scan);
    }
}

}  // namespace
}  // namespace hagen::recordings
