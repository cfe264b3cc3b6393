#include <gmock/gmock.h>
#include <hagen/avoidance/LoggedScans.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/simulation/LogClock.h>
#include <hagen/simulation/Scenarios.h>
#include <hagen/simulation/SceneDistance.h>
#include <mrpt/obs/CObservationComment.h>
#include "convert/RawlogWriter.h"
#include "recordings/PoseFile.h"

#include <algorithm>
#include <cmath>

#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
using mrpt::poses::CPose3D;

class LoggedScansTest : public testing::Test {
 protected:
    /// A log of clouds of a pole at 1 Hz from time 10 s, by a sensor 0.5 m ahead of the vehicle's
    /// origin and turned left by 90 degrees.
    fs::path poleLog(int scans) const {
        const test::SimpleScene scene = test::sceneOf({}, {{6, 1, 0.2, 5}});
        const auto labelled = test::scanScene(scene, sensorModel("VLP-16"), 870, {0, 0, 2});
        const fs::path file = folder_ / "pole.rawlog";
        convert::RawlogWriter writer(file, true);
        for (int i = 0; i < scans; ++i) {
            const auto cloud = observations::observationOf(labelled.scan, "lidar",
                                                           mrpt::Clock::fromDouble(10.0 + i));
            cloud->sensorPose = CPose3D(0.5, 0, 0, M_PI / 2, 0, 0);
            writer.write(*cloud);
        }
        writer.commit();
        return file;
    }
    /// Vehicle poses (2 t, 0, 2) at these times.
    fs::path posesAt(const std::vector<double>& times_s) const {
        std::vector<recordings::TimedPose> poses;
        for (const double t : times_s) poses.push_back({t, CPose3D(2 * t, 0, 2, 0, 0, 0)});
        recordings::writeTumPoses(folder_ / "flight.tum", poses);
        return folder_ / "flight.tum";
    }
    static std::string messageOf(const LogSource& source) {
        return test::messageOf([&] { LoggedScans scans(source); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(LoggedScansTest, PlacesPointsByPoses) {
    LoggedScans scans({poleLog(2), posesAt({10, 11}), "", {}});
    LoggedScan scan;
    ASSERT_TRUE(scans.next(scan));
    EXPECT_EQ(scan.entry, 0u);
    EXPECT_TRUE(scan.is_placed_by_one_pose);  // the clouds have no times
    EXPECT_EQ(scan.mapped.time_s, 10);
    EXPECT_NEAR((scan.mapped.origin_m - Eigen::Vector3f(20.5f, 0, 2)).norm(), 0, 1e-5);
    EXPECT_NEAR((scan.vehicle_m - Eigen::Vector3f(20, 0, 2)).norm(), 0, 1e-5);
    // The pole is ahead and left of the sensor, thus left of and behind the vehicle.
    const Eigen::Vector2f pole_m(20.5f - 1, 6);
    std::size_t roi = 0;
    for (std::size_t i = 0; i < scan.mapped.points_m.size(); ++i) {
        const Eigen::Vector3f& point_m = scan.mapped.points_m[i];
        if (scan.mapped.labels[i] != Label::Roi) {
            EXPECT_LT(point_m.z(), 0.6f);
            continue;
        }
        ++roi;
        EXPECT_NEAR((point_m.head<2>() - pole_m).norm(), 0.2, 0.01);
    }
    EXPECT_GT(roi, 50u);
    ASSERT_TRUE(scans.next(scan));
    EXPECT_NEAR(scan.vehicle_m.x(), 22, 1e-5);
    EXPECT_FALSE(scans.next(scan));
    EXPECT_TRUE(scans.flight_m().contains(Eigen::Vector3f(21, 0, 2)));
    EXPECT_EQ(scans.scans(), 2u);
}

TEST_F(LoggedScansTest, SkipsOwnReturns) {
    LogSource source{poleLog(1), posesAt({10}), "", {}};
    source.own_reach_m = 6.5f;
    LoggedScan scan;
    ASSERT_TRUE(LoggedScans(source).next(scan));
    EXPECT_FALSE(scan.mapped.points_m.empty());
    for (const auto& point_m : scan.mapped.points_m) {
        EXPECT_GT((point_m - scan.mapped.origin_m).norm(), 6.499f);
    }
}

/// The recording was flown at 4 m/s: 0.4 m per turn.
TEST_F(LoggedScansTest, PlacesReturnsAtTheirTimes) {
    LoggedScans scans({HAGEN_SOURCE_DIR "/rawlogs/orchard.rawlog", "", "", {}});
    EXPECT_THAT(scans.poseSource(), HasSubstr("CObservationRobotPose"));
    EXPECT_EQ(scans.scans(), 30u);
    EXPECT_EQ(scans.scansWithoutPose(), 0u);
    Eigen::AlignedBox3d box = scans.flight_m().cast<double>();
    box.extend(box.min() - Eigen::Vector3d::Constant(10));
    box.extend(box.max() + Eigen::Vector3d::Constant(10));
    const simulation::SceneDistance truth(simulation::makeScene("orchard", 1), box, 3);
    LoggedScan scan;
    for (int n = 0; n < 5; ++n) {
        ASSERT_TRUE(scans.next(scan));
        EXPECT_FALSE(scan.is_placed_by_one_pose);
        std::vector<float> off_m;
        for (const auto& point_m : scan.mapped.points_m) {
            if ((point_m - scan.mapped.origin_m).norm() > 8) continue;
            off_m.push_back(
                truth.at(point_m, scan.mapped.time_s - simulation::kSimulatedLogStart_s));
        }
        ASSERT_GT(off_m.size(), 1000u);
        std::nth_element(off_m.begin(), off_m.begin() + off_m.size() / 2, off_m.end());
        EXPECT_LT(off_m[off_m.size() / 2], 0.03f);
    }
}

TEST_F(LoggedScansTest, SkipsScansWithoutPose) {
    LoggedScans scans({poleLog(4), posesAt({10, 12}), "", {}});
    EXPECT_EQ(scans.scans(), 4u);
    EXPECT_EQ(scans.scansWithoutPose(), 2u);
    LoggedScan scan;
    ASSERT_TRUE(scans.next(scan));
    ASSERT_TRUE(scans.next(scan));
    EXPECT_EQ(scan.entry, 2u);
    EXPECT_FALSE(scans.next(scan));
}

TEST_F(LoggedScansTest, ReportsMissingData) {
    EXPECT_THAT(messageOf({folder_ / "none.rawlog", "", "", {}}),
                HasSubstr("none.rawlog: no such file"));
    EXPECT_THAT(messageOf({poleLog(1), "", "", {}}), HasSubstr("has no poses; provide them"));
    EXPECT_THAT(messageOf({poleLog(3), posesAt({5, 6}), "", {}}),
                HasSubstr("covers none of the scans in "));
    EXPECT_THAT(messageOf({poleLog(5), posesAt({10, 11}), "", {}}),
                HasSubstr("covers only 2 of 5 scans in "));
    EXPECT_THAT(messageOf({poleLog(1), posesAt({10}), "roof", {}}),
                HasSubstr("has no LiDAR scans labelled 'roof'; found: 'lidar'"));
    fs::create_directories(folder_ / "scans/velodyne");
    folder_.write("scans/velodyne/0.bin", "");
    EXPECT_THAT(messageOf({folder_ / "scans", posesAt({10}), "roof", {}}),
                HasSubstr("has no LiDAR scans labelled 'roof'; found: 'velodyne'"));
    mrpt::obs::CObservationComment comment;
    convert::RawlogWriter writer(folder_ / "words.rawlog", true);
    writer.write(comment);
    writer.commit();
    EXPECT_THAT(messageOf({folder_ / "words.rawlog", posesAt({10}), "", {}}),
                HasSubstr("has no LiDAR scan"));
}

TEST_F(LoggedScansTest, LookAheadIsInterruptible) {
    EXPECT_THROW(LoggedScans({poleLog(2), posesAt({10, 11}), "", {}}, [] { return false; }),
                 recordings::Interrupted);
}

TEST_F(LoggedScansTest, ReadsScansBeforeTruncation) {
    const fs::path log = poleLog(8);
    fs::resize_file(log, fs::file_size(log) * 3 / 4);
    LoggedScans scans({log, posesAt({10, 11, 12, 13, 14, 15, 16, 17}), "", {}});
    LoggedScan scan;
    ASSERT_TRUE(scans.next(scan));
    EXPECT_THROW(
        {
            while (scans.next(scan)) {
            }
        },
        recordings::BrokenRecording);
    EXPECT_LT(scan.entry, 8u);
}

}  // namespace
}  // namespace hagen::avoidance
