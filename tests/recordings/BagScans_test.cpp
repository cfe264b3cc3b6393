#include <gmock/gmock.h>
#include <hagen/mrpt/LocatedCloud.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include "mrpt/TableCloud.h"

#include <limits>

#include "support/BagWriter.h"
#include "support/OusterPackets.h"
#include "support/Program.h"
#include "support/ReadBag.h"
#include "support/SimpleFirings.h"

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;
using mrpt::poses::CPose3D;
using test::ByteString;
using test::kBagStart_s;
using test::ReadBag;
using test::readBag;
using test::SentMessage;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

namespace fs = std::filesystem;

std::vector<float> xOf(const CObservation::Ptr& scan) {
    const auto& x_m =
        dynamic_cast<const CObservationPointCloud&>(*scan).pointcloud->getPointsBufferRef_x();
    return {x_m.begin(), x_m.end()};
}

/// The points of the fixtures are (i, 2 i, -i / 2), i from 1 to 20.
void expectPoints(const CObservation::Ptr& scan) {
    const auto& cloud = *dynamic_cast<const CObservationPointCloud&>(*scan).pointcloud;
    ASSERT_EQ(cloud.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i) {
        const auto n = static_cast<float>(i + 1);
        EXPECT_EQ(cloud.getPointsBufferRef_x()[i], n);
        EXPECT_EQ(cloud.getPointsBufferRef_y()[i], 2 * n);
        EXPECT_EQ(cloud.getPointsBufferRef_z()[i], -n / 2);
    }
}

/// Files with the same messages, written by other programs.
class Fixture : public testing::TestWithParam<const char*> {
 protected:
    static fs::path file() {
        return fs::path(HAGEN_SOURCE_DIR) / "tests/recordings/data" / GetParam();
    }
};
INSTANTIATE_TEST_SUITE_P(Files, Fixture,
                         testing::Values("flight_bz2.bag", "flight_lz4.bag", "flight_zstd.mcap",
                                         "flight_ros1.mcap"),
                         [](const auto& file) {
                             std::string name = file.param;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(BagScans, ReportsOtherTypesOnTopic) {
    const test::TemporaryFolder folder;
    for (const char* name : {"mixed.mcap", "mixed.bag"}) {
        const std::vector<SentMessage> messages{
            test::cloudMessage("/points", kBagStart_s, "lidar", {1, 2, 3, 4}),
            test::odometryMessage("/points", kBagStart_s + 0.1, "odom", "base", 1, 2, 3),
            test::stringMessage("/points", kBagStart_s + 0.2, "none")};
        const fs::path file = folder / name;
        test::writeBytes(
            file, file.extension() == ".bag" ? test::ros1BagOf(messages) : test::mcapOf(messages));
        const ReadBag read = readBag(file);
        EXPECT_EQ(read.of("points").size(), 1u);
        EXPECT_THAT(read.scans->remarks(),
                    Contains(HasSubstr("unused topics: /points (std_msgs/String, 1 message)")));
    }
}

TEST_P(Fixture, ReadsEveryMessageType) {
    // Invalid metadata causes an error only for topics that need it.
    const BagOptions options{{"/cloud", "organised", "/livox", "/livox1", "/velodyne_packets"}, {}};
    const ReadBag read = readBag(file(), options);
    ASSERT_EQ(read.failed_because, "");
    ASSERT_EQ(read.of("cloud").size(), 1u);
    expectPoints(read.of("cloud")[0]);
    const auto* const table = observations::tableCloudOf(*read.of("cloud")[0]);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->rings()[4], 5);
    EXPECT_NEAR(table->times_s()[4], 0.005f, 1e-6f);
    EXPECT_EQ(table->table().fields.size(), 6u);
    EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(read.of("cloud")[0]->timestamp), kBagStart_s + 0.2);
    ASSERT_EQ(read.of("organised").size(), 1u);
    expectPoints(read.of("organised")[0]);
    ASSERT_EQ(read.of("livox").size(), 1u);
    expectPoints(read.of("livox")[0]);
    const auto livox = std::dynamic_pointer_cast<observations::LocatedCloud>(
        dynamic_cast<CObservationPointCloud&>(*read.of("livox")[0]).pointcloud);
    ASSERT_TRUE(livox);
    EXPECT_EQ(livox->sensor().name, "Mid-360");
    EXPECT_NEAR(livox->times_s()[19], 0.02f, 1e-6f);
    EXPECT_FLOAT_EQ((*observations::intensitiesOf(*livox))[9], 10 / 255.0f);
    ASSERT_EQ(read.of("livox1").size(), 1u);
    expectPoints(read.of("livox1")[0]);
    ASSERT_EQ(read.of("velodyne_packets").size(), 1u);
    const auto velodyne =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(read.of("velodyne_packets")[0]);
    ASSERT_TRUE(velodyne);
    ASSERT_EQ(velodyne->scan_packets.size(), 1u);
    EXPECT_EQ(test::bytesOf(velodyne->scan_packets[0]).substr(1100 + 4, 3), "\xc4\x09\x64");
    EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(velodyne->timestamp), kBagStart_s + 0.35);
    EXPECT_THAT(read.scans->remarks(),
                Contains(HasSubstr("unused topics: /ouster/lidar_packets (ouster_ros/PacketMsg, 1 "
                                   "message), /camera/image (std_msgs/String, 1 message)")));
}

TEST_P(Fixture, ReadsPosesFramesAndAttitudes) {
    const ReadBag read = readBag(file(), {{"/cloud", "/organised"}, {}});
    ASSERT_EQ(read.failed_because, "");
    const BagPlan& plan = read.scans->plan();
    ASSERT_TRUE(plan.poses);
    EXPECT_EQ(plan.poses->source, "nav_msgs/Odometry on /odom");
    EXPECT_EQ(plan.poses->child, "base_link");
    ASSERT_EQ(plan.poses->poses.size(), 6u);
    EXPECT_EQ(plan.poses->poses[3].x_m, 3);
    EXPECT_EQ(plan.poses->poses[3].z_m, 5);
    EXPECT_EQ(plan.poses->poses[3].qw, 1);
    EXPECT_EQ(plan.poses->poses[3].time_ns, 1700000000300000000);
    // The LiDAR is attached via a mast.
    const CPose3D on_vehicle(read.of("cloud")[0]->sensorPose());
    EXPECT_NEAR(on_vehicle.x(), 1, 1e-9);
    EXPECT_NEAR(on_vehicle.z(), 2, 1e-9);
    EXPECT_THAT(plan.remarks, Contains(HasSubstr("no static transform leads from the frame "
                                                 "'other' of /organised to 'base_link'")));
    ASSERT_EQ(read.of("/imu").size(), 2u);  // one per scan
    const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(read.of("/imu")[0]);
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_ORI_QUAT_X), 0.0998334166468, 1e-12);
    EXPECT_NEAR(imu->get(mrpt::obs::IMU_ORI_QUAT_W), 0.995004165278, 1e-12);
    EXPECT_EQ(read.survey.poses.at("/pose").poses[4].z_m, 4);
    EXPECT_EQ(read.survey.transforms.at("base_link").poses[4].y_m, 4);
}

TEST_P(Fixture, RejectsWrongOusterMetadata) {
    const ReadBag read = readBag(file());
    EXPECT_THAT(read.failed_because, HasSubstr(std::string(GetParam()) +
                                               ": topic /ouster/metadata: not Ouster metadata: "
                                               "the key 'beam_altitude_angles'"));
}

using BagScansTest = test::BagTest;

TEST_F(BagScansTest, LabelsEveryLidarTopic) {
    const ReadBag all = read({cloud("/front/points"), cloud("/front_points"), cloud("rear"),
                              cloud("/front/points", 0.1), cloud("/ground_non_roi")});
    EXPECT_EQ(all.failed_because, "");
    EXPECT_THAT(all.labels(), UnorderedElementsAre("front_points", "front_points_2", "rear",
                                                   "ground_non_roi_points"));
    EXPECT_EQ(all.of("front_points").size(), 2u);
    EXPECT_EQ(xOf(all.of("rear")[0]), (std::vector<float>{1, 5}));
    const ReadBag one = read({cloud("/a"), cloud("/b"), cloud("/a")}, {{"b"}, {}});
    EXPECT_THAT(one.labels(), ElementsAre("b"));
    EXPECT_EQ(one.observations.size(), 1u);
    EXPECT_THAT(one.scans->remarks(),
                Contains(HasSubstr("unused topics: /a (sensor_msgs/PointCloud2, 2 messages)")));
}

TEST_F(BagScansTest, RejectsMissingTopics) {
    const std::vector<SentMessage> messages{cloud("/points"), test::stringMessage("/text", 1, "a")};
    EXPECT_THAT(
        read(messages, {{"/lidar"}, {}}).failed_because,
        HasSubstr("flight.bag: has no topic '/lidar'; it has: /points "
                  "(sensor_msgs/PointCloud2, 1 message), /text (std_msgs/String, 1 message)"));
    EXPECT_THAT(read(messages, {{"/text"}, {}}).failed_because,
                HasSubstr("the topic '/text' has the type std_msgs/String, not a LiDAR type"));
    EXPECT_THAT(read({messages[1]}).failed_because,
                HasSubstr("has no LiDAR topic (sensor_msgs/PointCloud2, "));
    EXPECT_THAT(read({}).failed_because, HasSubstr("it has: none"));
    EXPECT_THAT(read(messages, {{}, folder_ / "none.json"}).failed_because,
                HasSubstr("no selected topic has Ouster packets"));
}

TEST_F(BagScansTest, PrefersPacketsToClouds) {
    const auto scan = test::poleScanFrom(1, "lidar");
    const std::vector<SentMessage> messages{
        test::velodyneMessage("/velodyne_packets", kBagStart_s, "velodyne", *scan, 1.3e-3),
        cloud("/velodyne_points", 0, "velodyne"), cloud("/rear", 0, "rear")};
    const ReadBag both = read(messages);
    EXPECT_THAT(both.labels(), UnorderedElementsAre("rear", "velodyne_packets"));
    EXPECT_THAT(both.scans->remarks(),
                Contains(HasSubstr("/velodyne_points is not read: its clouds are from the "
                                   "sensor with packets on /velodyne_packets; select it with "
                                   "--topic to read it")));
    const auto turn =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(both.of("velodyne_packets").at(0));
    ASSERT_EQ(turn->scan_packets.size(), scan->scan_packets.size());
    EXPECT_EQ(test::bytesOf(turn->scan_packets[3]), test::bytesOf(scan->scan_packets[3]));
    EXPECT_THAT(read(messages, {{"/velodyne_points"}, {}}).labels(),
                ElementsAre("velodyne_points"));
    // Clouds take precedence over packets of an unknown sensor.
    auto unknown = *scan;
    for (auto& packet : unknown.scan_packets) reinterpret_cast<char*>(&packet)[1205] = '\x61';
    const ReadBag clouds =
        read({test::velodyneMessage("/velodyne_packets", kBagStart_s, "velodyne", unknown, 1.3e-3),
              messages[1]});
    EXPECT_THAT(clouds.labels(), ElementsAre("velodyne_points"));
    EXPECT_THAT(clouds.scans->remarks(), Contains(HasSubstr("not from a known Velodyne")));
    const ReadBag none =
        read({test::velodyneMessage("/velodyne_packets", kBagStart_s, "velodyne", unknown, 1.3e-3)},
             {{"/velodyne_packets"}, {}});
    EXPECT_THAT(none.failed_because, HasSubstr("packets from an unknown Velodyne (model id 0x61)"));
}

TEST_F(BagScansTest, DetectsVelodyneByMajority) {
    const auto scan = test::poleScanFrom(1, "lidar");
    const auto sent = [&](double after_s, const CObservationVelodyneScan& packets) {
        return test::velodyneMessage("/packets", kBagStart_s + after_s, "velodyne", packets,
                                     1.3e-3);
    };
    CObservationVelodyneScan none, other = *scan, unknown = *scan;
    for (CObservationVelodyneScan* one : {&other, &unknown}) one->scan_packets.resize(1);
    reinterpret_cast<char*>(&other.scan_packets[0])[1205] = '\x21';  // an HDL-32E
    reinterpret_cast<char*>(&unknown.scan_packets[0])[1205] = '\x61';
    for (const CObservationVelodyneScan& first : {none, other, unknown}) {
        const ReadBag bag = read({sent(0, first), sent(0.1, *scan)});
        ASSERT_EQ(bag.of("packets").size(), 1u) << bag.failed_because;
        EXPECT_EQ(dynamic_cast<const CObservationVelodyneScan&>(*bag.of("packets")[0])
                      .scan_packets.size(),
                  scan->scan_packets.size());
    }
}

TEST_F(BagScansTest, IgnoresCloudsInFixedFrames) {
    const ReadBag bag = read(
        {cloud("/points"), cloud("/registered", 0, "camera_init"), cloud("/map_cloud", 0, "map"),
         test::odometryMessage("/odom", kBagStart_s, "camera_init", "body", 0, 0, 0)});
    EXPECT_THAT(bag.labels(), ElementsAre("points"));
    EXPECT_THAT(bag.scans->remarks(),
                Contains(HasSubstr("/registered is not read: its clouds are in the frame "
                                   "'camera_init', which does not move with the vehicle")));
    EXPECT_THAT(read({cloud("/map_cloud", 0, "map")}).failed_because,
                HasSubstr("select one with --topic to read it anyway"));
    EXPECT_EQ(read({cloud("/map_cloud", 0, "map")}, {{"/map_cloud"}, {}}).observations.size(), 1u);
}

SentMessage imuMessage(double since_s, const std::array<double, 4>& xyzw, double up_m_s2 = 9.81,
                       const std::string& frame = "imu") {
    return test::sentMessage("/imu", "sensor_msgs/Imu", kBagStart_s + since_s, [&](auto& bytes) {
        bytes.header(kBagStart_s + since_s, frame);
        for (const double part : xyzw) bytes.number(part);
        for (int i = 0; i < 9 + 3 + 9 + 2; ++i) bytes.number(0.0);
        bytes.number(up_m_s2);
        for (int i = 0; i < 9; ++i) bytes.number(0.0);
    });
}

TEST_F(BagScansTest, SortsMessagesByTime) {
    std::vector<SentMessage> by_topic;
    for (const char* topic : {"/b", "/a"}) {
        for (int i = 0; i < 5; ++i) by_topic.push_back(cloud(topic, 0.1 * i));
    }
    for (int i = 0; i < 5; ++i) {
        by_topic.push_back(
            imuMessage(0.1 * i - 0.01, {std::sin(0.1 * i), 0, 0, std::cos(0.1 * i)}));
    }
    const ReadBag bag = read(by_topic);
    ASSERT_EQ(bag.observations.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i) {
        const double since_s = 0.1 * static_cast<double>(i / 4) - (i % 2 == 0 ? 0.01 : 0);
        EXPECT_NEAR(mrpt::Clock::toDouble(bag.observations[i]->timestamp), kBagStart_s + since_s,
                    1e-6);
        EXPECT_EQ(bag.observations[i]->sensorLabel, i % 2 == 0 ? "/imu" : i % 4 == 1 ? "b" : "a");
    }
    EXPECT_THAT(bag.scans->remarks(), testing::Not(Contains(HasSubstr("out of order"))));
}

TEST_F(BagScansTest, DistrustsDefaultOrientation) {
    const std::array<double, 4> none{0, 0, 0, 1}, turned{1, 0, 0, 0};
    const auto imuOf = [&](const SentMessage& imu) { return read({imu, cloud("/a")}); };
    EXPECT_EQ(imuOf(imuMessage(0, none)).scans->plan().imu_topic, "/imu");
    EXPECT_EQ(imuOf(imuMessage(0, turned, -9.81)).scans->plan().imu_topic, "/imu");
    EXPECT_EQ(imuOf(imuMessage(0, none, -9.81)).scans->plan().imu_topic, "");
    EXPECT_THAT(
        imuOf(imuMessage(0, none, -9.81)).scans->remarks(),
        Contains(HasSubstr("all orientations are (0, 0, 0, 1), but gravity is 180 degrees")));
}

TEST_F(BagScansTest, ImuInLidarFrameContainsMount) {
    const auto hasImu = [&](const std::vector<SentMessage>& messages) {
        const ReadBag bag = read(messages);
        return bag.scans->plan().sensors.at("/points").has_imu;
    };
    const SentMessage points = cloud("/points"), imu = imuMessage(0, {1, 0, 0, 0});
    EXPECT_TRUE(hasImu({points, imuMessage(0, {1, 0, 0, 0}, 9.81, "lidar")}));
    EXPECT_FALSE(hasImu({points, imu}));
    EXPECT_TRUE(hasImu({points, imu, transform("/tf_static", "housing", "lidar", 0),
                        transform("/tf_static", "housing", "imu", 1)}));
    EXPECT_FALSE(hasImu({points, imu, transform("/tf_static", "base_link", "lidar", 0),
                         transform("/tf_static", "base_link", "imu", 1)}));
}

/// A cloud of 2 rows of 10 points (i, 2, -3).
SentMessage cloudOf(std::uint32_t row_step, bool is_flagged_big_endian, bool is_big_endian) {
    return test::sentMessage("/points", "sensor_msgs/PointCloud2", kBagStart_s, [&](auto& bytes) {
        bytes.header(kBagStart_s, "lidar").number(std::uint32_t{2}).number(std::uint32_t{10});
        bytes.number(std::uint32_t{3});
        for (const std::uint32_t i : {0u, 1u, 2u}) {
            bytes.text(std::string(1, "xyz"[i])).number(4 * i);
            bytes.number(std::uint8_t{7}).number(std::uint32_t{1});
        }
        bytes.number(static_cast<std::uint8_t>(is_flagged_big_endian));
        bytes.number(std::uint32_t{12}).number(row_step);
        ByteString data;
        for (int i = 0; i < 20; ++i) {
            for (const float at_m : {static_cast<float>(i), 2.0f, -3.0f}) {
                ByteString number(reinterpret_cast<const char*>(&at_m), sizeof at_m);
                if (is_big_endian) std::reverse(number.begin(), number.end());
                data += number;
            }
        }
        bytes.counted(data).number(std::uint8_t{1});
    });
}

TEST_F(BagScansTest, CorrectsRowStepAndByteOrder) {
    for (const std::uint32_t row_step : {0u, 10u, 120u, 240u}) {
        for (const bool flag : {false, true}) {
            for (const bool is_big : {false, true}) {
                SCOPED_TRACE(testing::Message() << row_step << " " << flag << is_big);
                const ReadBag bag = read({cloudOf(row_step, flag, is_big)});
                ASSERT_EQ(bag.failed_because, "");
                mrpt::math::TPoint3D last;
                const auto& points =
                    *dynamic_cast<CObservationPointCloud&>(*bag.observations.at(0)).pointcloud;
                points.getPoint(points.size() - 1, last.x, last.y, last.z);
                EXPECT_EQ(last, mrpt::math::TPoint3D(19, 2, -3));
                const auto reported = Contains(HasSubstr("is_bigendian is wrong"));
                EXPECT_EQ(testing::Matches(reported)(bag.scans->remarks()), flag != is_big);
            }
        }
    }
}

TEST_F(BagScansTest, SkipsDamagedChunk) {
    std::vector<SentMessage> messages;
    for (int i = 0; i < 10; ++i) messages.push_back(cloud("/points", 0.1 * i));
    for (const char* compression : {"none", "zstd"}) {
        ByteString mcap = test::mcapOf(messages, {compression, 2});
        const auto path = folder_ / "flight.mcap";
        mcap[mcap.size() / 2] = static_cast<char>(~mcap[mcap.size() / 2]);
        test::writeBytes(path, mcap);
        const ReadBag bag = readBag(path);
        EXPECT_EQ(bag.of("points").size(), 8u) << bag.failed_because;
        EXPECT_THAT(bag.failed_because, HasSubstr("the chunk at byte"));
        BagOptions options;
        options.first_scan = 6;
        const ReadBag later = readBag(path, options);
        EXPECT_EQ(later.failed_because, "");
        EXPECT_EQ(later.of("points").size(), 8u);
        EXPECT_THAT(later.scans->remarks(), Contains(HasSubstr("; skipped ")));
    }
}

TEST_F(BagScansTest, ReportsUnreadableMessages) {
    SentMessage cut = cloud("/points", 0.1), lying = cloud("/points", 0.2);
    cut.ros1.resize(cut.ros1.size() - 10);
    // The width follows the sequence number, time, frame and height.
    const std::size_t width_at = 4 + 8 + 4 + 5 + 4;
    lying.ros1.replace(width_at, 4, "\xff\xff\xff\xff");
    SentMessage text = test::stringMessage("/points", kBagStart_s + 0.25, "no cloud at all");
    text.type = "sensor_msgs/PointCloud2";
    const ReadBag bag = read({cloud("/points"), cut, lying, text, cloud("/points", 0.3)});
    EXPECT_EQ(bag.failed_because, "");
    EXPECT_EQ(bag.observations.size(), 2u);
    EXPECT_THAT(bag.scans->remarks(),
                Contains(HasSubstr("points (/points): 5 messages, 3 messages that could not be "
                                   "read, skipped; the first: message 1 (recorded at "
                                   "1700000000.100 s): it claims 32 elements, but has only ")));
    EXPECT_THAT(read({lying}).failed_because,
                HasSubstr("no scan could be read; /points: 1 message, 1 message that could not "
                          "be read, skipped; the first: "
                          "message 0 (recorded at 1700000000.200 s): it "
                          "claims 4294967295 x 1 points of 16 bytes, but has 32 bytes"));
}

TEST_F(BagScansTest, UnpacksDatabaseMessages) {
    std::vector<SentMessage> messages{cloud("/points"), cloud("/points", 0.1)};
    messages[0].cdr = test::packed(messages[0].cdr, "zstd");
    const ReadBag bag = readBag(test::writeDb3(folder_ / "flight.db3", messages));
    EXPECT_EQ(bag.failed_because, "");
    ASSERT_EQ(bag.observations.size(), 2u);
    EXPECT_EQ(xOf(bag.observations[0]), (std::vector<float>{1, 5}));
}

TEST_F(BagScansTest, ScalesNormalizedTimesByPeriod) {
    const auto lastTime = [&](const std::vector<double>& since_s) {
        std::vector<SentMessage> messages;
        for (const double at_s : since_s) {
            messages.push_back(test::cloudMessage("/points", kBagStart_s + at_s, "lidar",
                                                  {1, 2, 3, 0, 4, 5, 6, 0.95f}));
            test::ByteString& bytes = messages.back().ros1;
            const test::ByteString name("\x09\0\0\0intensity", 13);
            bytes.replace(bytes.find(name), name.size(), test::ByteString("\x04\0\0\0time", 8));
        }
        const auto scan = read(messages).of("points").at(0);
        return observations::tableCloudOf(*scan)->times_s()[1];
    };
    EXPECT_NEAR(lastTime({0, 0.11, 0.2}), 0.095, 1e-6);
    EXPECT_FLOAT_EQ(lastTime({0, 1, 2}), 0.95f);
    EXPECT_FLOAT_EQ(lastTime({0}), 0.95f);
}

TEST_F(BagScansTest, RejectsUnknownSerialisations) {
    SentMessage message = cloud("/points");
    message.cdr[1] = '\7';  // XCDR2
    EXPECT_THAT(readBag(test::writeDb3(folder_ / "flight.db3", {message})).failed_because,
                HasSubstr("it is not plain CDR (its header is 0 7)"));
    const ReadBag cut = readBag(test::writeDb3(
        folder_ / "flight.db3",
        {test::sentMessage("/points", "sensor_msgs/PointCloud2", kBagStart_s,
                           [](test::MessageBytes& bytes) { bytes.number(std::uint32_t{0}); })}));
    EXPECT_THAT(cut.failed_because, HasSubstr("bytes missing at its end"));
}

TEST_F(BagScansTest, ReadsOusterMetadataFromBag) {
    const auto sensor = sensors::ousterSensorOf(test::ousterJson(), "here");
    std::vector<SentMessage> messages{cloud("/ouster/points", 0, "os_sensor"),
                                      transform("/tf_static", "base_link", "os_sensor", 3)};
    for (std::uint16_t id = 1; id <= 3; ++id) {
        for (const auto& packet : test::packetsOf(sensor, test::randomFrame(sensor, id))) {
            messages.push_back(test::sentMessage(
                "/ouster/lidar_packets", "ouster_ros/PacketMsg", kBagStart_s + 0.1 * id,
                [&](test::MessageBytes& bytes) { bytes.counted(packet + '\0'); }));
        }
        messages.push_back(test::sentMessage(
            "/ouster/imu_packets", "ouster_ros/PacketMsg", kBagStart_s,
            [&](test::MessageBytes& bytes) { bytes.counted(test::ByteString(48, '\0')); }));
    }
    EXPECT_THAT(read(messages).labels(), ElementsAre("ouster_points"));
    EXPECT_THAT(read(messages).scans->remarks(),
                Contains(HasSubstr("/ouster/lidar_packets is not read: Ouster packets require "
                                   "metadata, which the bag lacks; pass them with --sensor-json "
                                   "FILE")));
    EXPECT_THAT(read(messages, {{"/ouster/lidar_packets"}, {}}).failed_because,
                HasSubstr("the bag has no topic '/ouster/metadata'"));
    const fs::path json = folder_.write("os.json", test::ousterJson());
    EXPECT_EQ(read(messages, {{}, json}).of("ouster_lidar_packets").size(), 3u);
    // The metadata may be the last message.
    messages.push_back(
        test::stringMessage("/ouster/metadata", kBagStart_s + 1, test::ousterJson()));
    const ReadBag bag = read(messages);
    EXPECT_THAT(bag.labels(), ElementsAre("ouster_lidar_packets"));
    ASSERT_EQ(bag.of("ouster_lidar_packets").size(), 3u);
    EXPECT_THAT(bag.scans->remarks(), Contains(HasSubstr("/ouster/points is not read")));
    EXPECT_THAT(bag.scans->remarks(), Contains(HasSubstr("OS-0-32-U1, ")));
    const auto scan = bag.of("ouster_lidar_packets")[1];
    EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(scan->timestamp), kBagStart_s + 0.2);
    EXPECT_NEAR(CPose3D(scan->sensorPose()).x(), 3, 1e-9);
    EXPECT_NEAR(CPose3D(scan->sensorPose()).z(), sensor.lidar_to_sensor.translation().z(), 1e-9);
    // These packets have another profile.
    const fs::path other = folder_.write("other.json", test::ousterJson("LEGACY"));
    EXPECT_THAT(read(messages, {{}, other}).failed_because,
                HasSubstr("Is it another sensor's metadata?"));
}

TEST_F(BagScansTest, KeepsTurnBeforeTruncation) {
    const auto scan = test::poleScanFrom(1, "lidar");
    std::vector<SentMessage> messages;
    for (int i = 0; i < 3; ++i) {
        messages.push_back(test::velodyneMessage("/velodyne_packets", kBagStart_s + 0.1 * i,
                                                 "velodyne", *scan, 1.3e-3));
    }
    test::BagShape shape;
    shape.messages_per_chunk = 1;
    const test::ByteString whole = test::ros1BagOf(messages, shape);
    const ReadBag cut =
        readBag(test::writeBytes(folder_ / "cut.bag", whole.substr(0, whole.size() * 7 / 10)));
    EXPECT_THAT(cut.failed_because, HasSubstr("cut.bag: a record at byte "));
    EXPECT_GE(cut.observations.size(), 1u);
    EXPECT_FALSE(cut.survey.is_whole);
    EXPECT_THAT(readBag(folder_ / "cut.bag", {{"/rear"}, {}}).failed_because,
                testing::AllOf(
                    HasSubstr("has no topic '/rear'; it has: /velodyne_packets"),
                    HasSubstr("only partly readable: " + (folder_ / "cut.bag").string() + ": ")));
}

TEST_F(BagScansTest, ReportsUnusedFieldsAndPoints) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    const auto withRing = [](double since_s, float ring, float x) {
        SentMessage message = test::cloudMessage("/points", kBagStart_s + since_s, "lidar",
                                                 {x, 2, 3, ring, kNone, 6, 7, 8});
        const std::string intensity("\x09\0\0\0intensity", 13);
        message.ros1.replace(message.ros1.find(intensity), intensity.size(),
                             std::string("\x04\0\0\0ring", 8));
        return message;
    };
    const ReadBag bag = read({withRing(0, 1, 1), withRing(0.1, 0.5, 1), withRing(0.2, 2, kNone)});
    EXPECT_EQ(xOf(bag.of("points")[1]), std::vector<float>{1});
    EXPECT_THAT(
        bag.scans->remarks(),
        Contains("points (/points): 3 messages, 4 points with non-finite coordinates, dropped "
                 "from the scans (--clouds writes them with label 0); the field 'ring' "
                 "is not used: some values are not beam numbers (1 of 3 clouds)"));
}

TEST_F(BagScansTest, CountsLivoxPointsWithoutRange) {
    const auto livox = [](const std::string& driver) {
        return test::sentMessage("/" + driver, driver + "/CustomMsg", kBagStart_s,
                                 [](test::MessageBytes& bytes) {
                                     bytes.header(kBagStart_s, "livox").number(std::uint64_t{0});
                                     bytes.number(std::uint32_t{3}).raw(std::string(4, '\0'));
                                     bytes.number(std::uint32_t{3});
                                     for (const float x_m : {0.0f, 4.0f, 0.0f}) {
                                         bytes.number(std::uint32_t{0});
                                         for (const float part : {x_m, 0.0f, 0.0f})
                                             bytes.number(part);
                                         bytes.raw({'\1', x_m > 0 ? '\7' : '\5', '\3'});
                                     }
                                 });
    };
    const ReadBag bag = read({livox("livox_ros_driver"), livox("livox_ros_driver2")});
    for (const std::string driver : {"livox_ros_driver", "livox_ros_driver2"}) {
        EXPECT_EQ(xOf(bag.of(driver).at(0)), std::vector<float>{4});
        EXPECT_THAT(
            bag.scans->remarks(),
            Contains(driver + " (/" + driver + "): 1 message, 2 points without a range, skipped"));
    }
    const auto& cloud =
        dynamic_cast<const CObservationPointCloud&>(*bag.of("livox_ros_driver2")[0]);
    const auto& fields =
        dynamic_cast<const observations::LocatedCloud&>(*cloud.pointcloud).otherFields();
    EXPECT_THAT(columnOf(fields, *findField(fields, {"tag"})), ElementsAre(7));
    EXPECT_THAT(columnOf(fields, *findField(fields, {"line"})), ElementsAre(3));
}

}  // namespace
}  // namespace hagen::recordings
