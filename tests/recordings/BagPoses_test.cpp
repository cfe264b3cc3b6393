#include <gmock/gmock.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>

#include "support/ReadBag.h"

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;
using test::kBagStart_s;
using test::ReadBag;
using test::SentMessage;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// Poses of the vehicle and mounts of its sensors.
using BagPosesTest = test::BagTest;

/// A message with one transform on /tf.
SentMessage moved(double since_s, const std::string& parent, const std::string& child, double x,
                  double y, double z, double yaw_rad = 0) {
    return test::sentMessage("/tf", "tf2_msgs/TFMessage", kBagStart_s + since_s,
                             [&](test::MessageBytes& bytes) {
                                 bytes.number(1u).header(kBagStart_s + since_s, parent);
                                 bytes.text(child).pose(x, y, z, yaw_rad);
                             });
}

/// A vehicle that flies along x at 10 m/s, rotated to the left, and climbs at 1 m/s. A separate
/// frame has its height; base_link is 2 m ahead of that frame and rotates.
std::vector<SentMessage> climbingVehicle(const std::vector<SentMessage>& others) {
    std::vector<SentMessage> messages = others;
    for (const double since_s : {0.0, 0.1, 0.2}) {
        messages.push_back(moved(since_s, "base_footprint", "base_stabilized", 0, 0, since_s));
        messages.push_back(moved(since_s, "base_stabilized", "base_link", 2, 0, 0, since_s));
    }
    return messages;
}

/// Expects base_link's poses at all times for which all frames of the vehicle are known. Times are
/// interpolated as double seconds since 1970, which have microsecond accuracy.
void expectClimb(const PoseSeries& series) {
    ASSERT_EQ(series.poses.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const double since_s = 0.05 * static_cast<double>(i + 1);
        const RecordedPose& pose = series.poses[i];
        EXPECT_NEAR(1e-9 * static_cast<double>(pose.time_ns - 1700000000000000000), since_s, 1e-9);
        EXPECT_NEAR(pose.x_m, 10 * since_s, 1e-4);
        EXPECT_NEAR(pose.y_m, 2, 1e-4);
        EXPECT_NEAR(pose.z_m, since_s, 1e-4);
        EXPECT_NEAR(2 * std::atan2(pose.qz, pose.qw), M_PI / 2 + since_s, 1e-4);
    }
}

TEST_F(BagPosesTest, PrefersOdometryToTransforms) {
    const ReadBag odometry_only =
        read({cloud("/points", 0, "base_link"), odometry(0, 1), odometry(0.1, 2),
              odometry(0.102, 2.1), transform("/tf", "odom", "base_link", 7)});
    EXPECT_EQ(odometry_only.scans->plan().poses->source, "nav_msgs/Odometry on /odom");
    EXPECT_EQ(odometry_only.scans->plan().poses->poses.size(), 2u);  // at least 10 ms apart
    const ReadBag moved =
        read({cloud("/points"), transform("/tf", "map", "odom", 100),
              transform("/tf", "odom", "base", 1, 0), transform("/tf", "odom", "base", 2, 0.1),
              transform("/tf_static", "base", "lidar", 5)});
    ASSERT_TRUE(moved.scans->plan().poses);
    EXPECT_EQ(moved.scans->plan().poses->source, "transforms from odom to base");
    EXPECT_EQ(moved.scans->plan().poses->poses.at(1).x_m, 2);
    EXPECT_NEAR(CPose3D(moved.of("points")[0]->sensorPose()).x(), 5, 1e-9);
    EXPECT_FALSE(read({cloud("/points")}).scans->plan().poses);
    // Infrequent poses (a goal, or map corrections) do not place scans.
    const auto seldom = [&](double since_s) {
        return test::sentMessage("/goal", "geometry_msgs/PoseStamped", kBagStart_s + since_s,
                                 [&](test::MessageBytes& bytes) {
                                     bytes.header(kBagStart_s + since_s, "map").pose(9, 9, 9);
                                 });
    };
    const ReadBag goals = read(
        {cloud("/points"), seldom(0), seldom(5), seldom(10), transform("/tf", "odom", "lidar", 1)});
    EXPECT_EQ(goals.scans->plan().poses->source, "transforms from odom to lidar");
}

TEST_F(BagPosesTest, FollowsMountThroughFrames) {
    // The odometry is that of the IMU, which is mounted beside the LiDAR.
    const ReadBag bag = read({transform("/tf_static", "base_link", "lidar", 5),
                              transform("/tf_static", "base_link", "imu", 2), odometry(0, 0, "imu"),
                              odometry(0.1, 0, "imu"), cloud("/points")});
    EXPECT_NEAR(CPose3D(bag.of("points")[0]->sensorPose()).x(), 3, 1e-9);
    // In ROS 1, constant transforms are often repeated on tf.
    const ReadBag still = read({transform("/tf", "base_link", "lidar", 4),
                                transform("/tf", "base_link", "lidar", 4, 0.1), odometry(0, 0),
                                odometry(0.1, 1), cloud("/points")});
    EXPECT_NEAR(CPose3D(still.of("points")[0]->sensorPose()).x(), 4, 1e-9);
    // Circular frames do not cause an endless loop.
    const ReadBag circle =
        read({transform("/tf_static", "a", "lidar", 1), transform("/tf_static", "lidar", "a", 1),
              odometry(0, 0), cloud("/points")});
    EXPECT_EQ(circle.failed_because, "");
}

TEST_F(BagPosesTest, TreatsConstantTransformsAsStatic) {
    std::vector<SentMessage> messages{cloud("/points"),
                                      transform("/tf_static", "base_link", "lidar", 5)};
    for (const double since_s : {0.0, 0.1, 0.2}) {
        messages.push_back(transform("/tf", "base_footprint", "base_link", 0.5, since_s));
        messages.push_back(transform("/tf", "odom", "base_footprint", 10 * since_s, since_s));
    }
    const ReadBag bag = read(messages);
    ASSERT_TRUE(bag.scans->plan().poses);
    EXPECT_EQ(bag.scans->plan().poses->source, "transforms from odom to base_footprint");
    EXPECT_NEAR(CPose3D(bag.of("points")[0]->sensorPose()).x(), 5.5, 1e-9);
    // The vehicle's frame may have any name.
    const ReadBag body =
        read({cloud("/points"), transform("/tf", "body", "lidar", 3),
              transform("/tf", "body", "lidar", 3, 0.1), transform("/tf", "earth", "body", 1),
              transform("/tf", "earth", "body", 2, 0.1)});
    EXPECT_EQ(body.scans->plan().poses->source, "transforms from earth to body");
    EXPECT_NEAR(CPose3D(body.of("points")[0]->sensorPose()).x(), 3, 1e-9);
    // No frame moves because the vehicle is parked.
    const ReadBag parked =
        read({cloud("/points"), transform("/tf", "odom", "lidar", 1),
              transform("/tf", "odom", "lidar", 1, 0.1), transform("/tf", "map", "odom", 1)});
    EXPECT_EQ(parked.scans->plan().poses->source, "transforms from odom to lidar");
}

TEST_F(BagPosesTest, ComposesMovingTransforms) {
    const ReadBag bag = read(
        climbingVehicle({cloud("/points"), transform("/tf_static", "base_link", "lidar", 5),
                         moved(0, "map", "odom", 100, 0, 0), moved(0.1, "map", "odom", 200, 0, 0),
                         moved(0.05, "odom", "base_footprint", 0.5, 0, 0, M_PI / 2),
                         moved(0.15, "odom", "base_footprint", 1.5, 0, 0, M_PI / 2)}));
    ASSERT_TRUE(bag.scans->plan().poses);
    EXPECT_EQ(bag.scans->plan().poses->source, "transforms from odom to base_link");
    expectClimb(*bag.scans->plan().poses);
    EXPECT_NEAR(CPose3D(bag.of("points")[0]->sensorPose()).x(), 5, 1e-9);
    EXPECT_THAT(bag.scans->plan().remarks, testing::IsEmpty());
    // Constant transforms in between are applied.
    const ReadBag still =
        read({cloud("/points"), moved(0, "base_link", "lidar", 0, 0, 1),
              moved(0.1, "base_link", "lidar", 0, 0, 2), transform("/tf", "odom", "base_link", 7)});
    ASSERT_TRUE(still.scans->plan().poses);
    EXPECT_EQ(still.scans->plan().poses->source, "transforms from odom to lidar");
    EXPECT_NEAR(still.scans->plan().poses->poses.at(1).x_m, 7, 1e-9);
    EXPECT_NEAR(still.scans->plan().poses->poses.at(1).z_m, 2, 1e-9);
}

TEST_F(BagPosesTest, ComposesOdometryWithTransforms) {
    const auto flown = [](double since_s) {
        return test::sentMessage("/odom", "nav_msgs/Odometry", kBagStart_s + since_s,
                                 [&](test::MessageBytes& bytes) {
                                     bytes.header(kBagStart_s + since_s, "odom");
                                     bytes.text("base_footprint");
                                     bytes.pose(10 * since_s, 0, 0, M_PI / 2);
                                     for (int i = 0; i < 36 + 6 + 36; ++i) bytes.number(0.0);
                                 });
    };
    const std::vector<SentMessage> messages =
        climbingVehicle({cloud("/points"), transform("/tf_static", "base_link", "lidar", 5),
                         flown(0.05), flown(0.15)});
    const ReadBag bag = read(messages);
    EXPECT_EQ(bag.scans->plan().poses->source,
              "nav_msgs/Odometry on /odom and transforms from base_footprint to base_link");
    expectClimb(*bag.scans->plan().poses);
    EXPECT_NEAR(CPose3D(bag.of("points")[0]->sensorPose()).x(), 5, 1e-9);
    EXPECT_THAT(bag.scans->plan().remarks, testing::IsEmpty());
    // Another LiDAR is attached to the odometry frame, so the poses of the odometry are used.
    std::vector<SentMessage> with_other = messages;
    with_other.push_back(cloud("/down", 0, "base_footprint"));
    const ReadBag two = read(with_other);
    EXPECT_EQ(two.scans->plan().poses->source, "nav_msgs/Odometry on /odom");
    EXPECT_THAT(
        two.scans->plan().remarks,
        ElementsAre(HasSubstr("no static transform leads from the frame 'lidar' of /points "
                              "to 'base_footprint': using the poses of nav_msgs/Odometry on "
                              "/odom as sensor poses")));
}

TEST_F(BagPosesTest, IgnoresTransformsWithinVehicle) {
    const ReadBag within = read({cloud("/points"), transform("/tf_static", "base_link", "lidar", 5),
                                 transform("/tf", "base_footprint", "base_link", 1),
                                 transform("/tf", "base_footprint", "base_link", 2, 0.1)});
    EXPECT_FALSE(within.scans->plan().poses);
    EXPECT_THAT(within.scans->plan().remarks,
                ElementsAre("the transforms from 'base_footprint' to 'base_link' do not locate "
                            "'base_footprint', so they provide no poses"));
    const ReadBag apart = read({cloud("/points"), transform("/tf", "base_link", "lidar", 1),
                                transform("/tf", "base_link", "lidar", 2, 0.1),
                                transform("/tf", "odom", "base_link", 1, 5),
                                transform("/tf", "odom", "base_link", 2, 5.1)});
    EXPECT_FALSE(apart.scans->plan().poses);
    EXPECT_THAT(
        apart.scans->plan().remarks,
        ElementsAre("the transforms from 'odom' to 'lidar' have no times in common, so they "
                    "provide no poses"));
    const ReadBag circle =
        read({cloud("/points"), transform("/tf", "a", "lidar", 1),
              transform("/tf", "a", "lidar", 2, 0.1), transform("/tf", "lidar", "a", 1),
              transform("/tf", "lidar", "a", 2, 0.1)});
    EXPECT_FALSE(circle.scans->plan().poses);
    EXPECT_THAT(circle.scans->plan().remarks, ElementsAre(HasSubstr("form a cycle")));
}

TEST_F(BagPosesTest, IgnoresMapTransforms) {
    const ReadBag bag =
        read({cloud("/map_cloud", 0, "map"), cloud("/points", 0, "base"),
              transform("/tf", "earth", "map", 1), transform("/tf", "earth", "map", 2, 0.1),
              transform("/tf", "odom", "base", 3), transform("/tf", "odom", "base", 4, 0.1)});
    EXPECT_THAT(bag.labels(), ElementsAre("points"));
    EXPECT_EQ(bag.scans->plan().poses->source, "transforms from odom to base");
}

TEST_F(BagPosesTest, ReportsSensorOnOtherFrame) {
    const SentMessage imu =
        test::sentMessage("/imu", "sensor_msgs/Imu", kBagStart_s, [](test::MessageBytes& bytes) {
            bytes.header(kBagStart_s, "imu");
            for (const double part : {0.0, 0.0, 0.0, 1.0}) bytes.number(part);
            for (int i = 0; i < 9 + 2 * (3 + 9); ++i) bytes.number(0.0);
        });
    std::vector<SentMessage> messages{cloud("/points"), imu,
                                      transform("/tf_static", "os_sensor", "lidar", 5),
                                      transform("/tf_static", "imu_case", "imu", 5)};
    // Without poses, the sensor may have any frame.
    const ReadBag alone = read(messages);
    EXPECT_NEAR(CPose3D(alone.of("points")[0]->sensorPose()).x(), 5, 1e-9);
    EXPECT_EQ(alone.scans->plan().imu_topic, "/imu");
    EXPECT_THAT(alone.scans->plan().remarks, testing::IsEmpty());
    messages.push_back(odometry(0, 0));
    messages.push_back(odometry(0.1, 1));
    const ReadBag bag = read(messages);
    EXPECT_EQ(CPose3D(bag.of("points")[0]->sensorPose()).x(), 0);
    EXPECT_EQ(bag.scans->plan().imu_topic, "");
    EXPECT_THAT(bag.scans->plan().remarks,
                ElementsAre(HasSubstr("no static transform leads from the frame 'lidar' of "
                                      "/points to 'base_link'")));
}

TEST_F(BagPosesTest, IgnoresMountInOtherFrame) {
    const ReadBag bag = read({cloud("/points"), transform("/tf_static", "base_link", "lidar", 5),
                              odometry(0, 0, "body"), odometry(0.1, 1, "body")});
    EXPECT_EQ(CPose3D(bag.of("points")[0]->sensorPose()).x(), 0);
    EXPECT_THAT(bag.scans->plan().remarks,
                ElementsAre(HasSubstr("no static transform leads from the frame 'lidar' of /points "
                                      "to 'body'")));
}

TEST_F(BagPosesTest, SkipsUnreadableTransform) {
    const auto transforms = [](const std::string& topic) {
        return test::sentMessage(
            topic, "tf2_msgs/TFMessage", kBagStart_s, [](test::MessageBytes& bytes) {
                bytes.number(std::uint32_t{3});
                bytes.header(kBagStart_s, "base_link").text("front").pose(1, 0, 0);
                bytes.header(kBagStart_s, "base_link").text("broken");
                for (int i = 0; i < 7; ++i) bytes.number(0.0);
                bytes.header(kBagStart_s, "base_link").text("rear").pose(-1, 0, 0);
            });
    };
    const std::vector<SentMessage> clouds{cloud("/front", 0, "front"), cloud("/rear", 0, "rear"),
                                          odometry(0, 0), odometry(0.1, 1)};
    for (const std::string topic : {"/tf_static", "/tf"}) {
        std::vector<SentMessage> messages = clouds;
        messages.push_back(transforms(topic));
        const ReadBag bag = read(messages);
        EXPECT_NEAR(CPose3D(bag.of("front")[0]->sensorPose()).x(), 1, 1e-9) << topic;
        EXPECT_NEAR(CPose3D(bag.of("rear")[0]->sensorPose()).x(), -1, 1e-9) << topic;
        EXPECT_THAT(
            bag.scans->remarks(),
            Contains(topic + ": 1 message skipped; the first: "
                             "message 0 (recorded at 1700000000.000 s): from 'base_link' "
                             "to 'broken': it has non-finite values or an invalid quaternion"));
    }
}

TEST_F(BagPosesTest, CountsExcessFrames) {
    const auto transforms = [](const std::string& topic, std::size_t frames) {
        const auto write = [&](test::MessageBytes& bytes) {
            bytes.number(static_cast<std::uint32_t>(frames));
            for (std::size_t i = 0; i < frames; ++i) {
                bytes.header(kBagStart_s, "base_link").text("f" + std::to_string(i)).pose(1, 0, 0);
            }
        };
        return test::sentMessage(topic, "tf2_msgs/TFMessage", kBagStart_s, write);
    };
    const ReadBag bag = read({cloud("/points"), transforms("/tf", kMaxMovingFrames + 2),
                              // A known frame is not counted as excess.
                              transform("/tf", "base_link", "f0", 2, 0.1),
                              transforms("/tf_static", FrameTree::kMaxFrames + 2)});
    EXPECT_EQ(bag.survey.transforms.size(), kMaxMovingFrames);
    EXPECT_EQ(bag.survey.transforms.at("f0").poses.size(), 2u);
    EXPECT_THAT(bag.scans->remarks(),
                Contains("/tf: 2 messages skipped; the first: message 0 (recorded at "
                         "1700000000.000 s): from 'base_link' to 'f1000': too many frames"));
    EXPECT_THAT(bag.scans->remarks(), Contains(HasSubstr("/tf_static: 2 messages skipped")));
}

TEST_F(BagPosesTest, ReportsFrameAttachedToItself) {
    const ReadBag bag = read({cloud("/points"), transform("/tf_static", "lidar", "lidar", 1)});
    EXPECT_THAT(bag.scans->remarks(),
                Contains(HasSubstr("/tf_static: 1 message skipped; the "
                                   "first: message 0 (recorded at 1700000000.000 s): from 'lidar' "
                                   "to 'lidar': a frame cannot be its own parent")));
}

TEST_F(BagPosesTest, ReportsUnreadablePoses) {
    SentMessage cut = odometry(0.1, 1);
    cut.ros1.resize(60);
    const ReadBag bag = read({cloud("/points"), odometry(0, 0), cut, odometry(0.2, 2), cut});
    EXPECT_EQ(bag.scans->plan().poses->poses.size(), 2u);
    EXPECT_THAT(bag.scans->remarks(),
                Contains(HasSubstr("/odom: 2 messages skipped; the first: "
                                   "message 1 (recorded at 1700000000.100 s): bytes missing ")));
}

TEST_F(BagPosesTest, SeparatesFrameParents) {
    const ReadBag bag = read({cloud("/points"), transform("/tf", "odom", "lidar", 1),
                              transform("/tf", "map", "lidar", 100, 0.05),
                              transform("/tf", "odom", "lidar", 2, 0.1),
                              transform("/tf", "map", "lidar", 101, 0.15)});
    EXPECT_EQ(bag.scans->plan().poses->source, "transforms from odom to lidar");
    ASSERT_EQ(bag.scans->plan().poses->poses.size(), 2u);
    EXPECT_EQ(bag.scans->plan().poses->poses[1].x_m, 2);
    EXPECT_THAT(
        bag.scans->remarks(),
        Contains(
            "/tf: 2 messages skipped; the first: message 1 (recorded at 1700000000.050 s): from "
            "'map' to 'lidar', before from 'odom'"));
}

}  // namespace
}  // namespace hagen::recordings
