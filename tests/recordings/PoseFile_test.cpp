#include "recordings/PoseFile.h"
#include <gmock/gmock.h>
#include <hagen/recordings/LogPoses.h>

#include "support/Program.h"
#include "support/Random.h"

namespace hagen::recordings {
namespace {

using testing::HasSubstr;

using mrpt::poses::CPose3D;

class PoseFile : public testing::Test {
 protected:
    void expectRefused(const std::string& text, const std::string& words) {
        const auto file = folder_.write("poses", text);
        const auto read = [&] {
            kindOfPoseFile(file) == PoseFileKind::Tum ? (void)readTumPoses(file)
                                                      : (void)readKittiPoses(file);
        };
        const std::string message = test::messageOf(read);
        EXPECT_THAT(message, HasSubstr(words));
        EXPECT_THAT(message, HasSubstr((folder_ / "poses").string()));
    }
    test::TemporaryFolder folder_;
};

TEST_F(PoseFile, ReadsTumPoses) {
    // (0, 0, sin 45, cos 45) is a quarter turn to the left.
    const auto file = folder_.write(
        "a.tum", "# time x y z qx qy qz qw\n\n12.5 1 2 3 0 0 0.70710678 0.70710678\n");
    EXPECT_EQ(kindOfPoseFile(file), PoseFileKind::Tum);
    const auto poses = readTumPoses(file);
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].time_s, 12.5);
    EXPECT_NEAR((poses[0].pose - CPose3D(1, 2, 3, M_PI / 2, 0, 0)).norm(), 0.0, 1e-6);
    EXPECT_NEAR(poses[0].pose.yaw(), M_PI / 2, 1e-6);
}

TEST_F(PoseFile, ReadsSpreadsheetExports) {
    const auto file =
        folder_.write("a.tum", "\xef\xbb\xbf# time x y z\r\n1 +2 -3e+0 .5 0 0 0 1\r\n");
    const auto poses = readTumPoses(file);
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ((poses[0].pose - CPose3D(2, -3, 0.5, 0, 0, 0)).norm(), 0.0);
    expectRefused("+-1 0 0 0 0 0 0 1\n", "'+-1' is not a finite number");
}

TEST_F(PoseFile, ReadsKittiMatrices) {
    const auto file = folder_.write("a.txt", "0 -1 0 5 1 0 0 6 0 0 1 7\n");
    EXPECT_EQ(kindOfPoseFile(file), PoseFileKind::Kitti);
    const CPose3D pose = readKittiPoses(file).at(0);
    EXPECT_NEAR(pose.y(), 6.0, 1e-9);
    EXPECT_NEAR(pose.yaw(), M_PI / 2, 1e-9);
}

TEST_F(PoseFile, ReadsWrittenPoses) {
    test::Random random(31);
    std::vector<TimedPose> poses;
    std::vector<CPose3D> sensor_poses;
    for (int i = 0; i < 50; ++i) {
        const auto number = [&] { return static_cast<double>(random.real(-1, 1)); };
        poses.push_back(
            {1767225600.0 + 0.1 * i, CPose3D(9 * number(), 9 * number(), 9 * number(), 3 * number(),
                                             1.5 * number(), 3 * number())});
        sensor_poses.push_back(poses.back().pose);
    }
    writeTumPoses(folder_ / "a.tum", poses);
    writeKittiPoses(folder_ / "a.txt", sensor_poses);
    const auto tum = readTumPoses(folder_ / "a.tum");
    const auto kitti = readKittiPoses(folder_ / "a.txt");
    for (int i = 0; i < 50; ++i) {
        EXPECT_NEAR(tum[i].time_s, poses[i].time_s, 1e-6);
        const auto a = tum[i].pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        const auto b = poses[i].pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        const auto c =
            (poses[0].pose + kitti[i]).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        for (int k = 0; k < 12; ++k) {
            ASSERT_NEAR(a(k / 4, k % 4), b(k / 4, k % 4), 1e-7);
            ASSERT_NEAR(c(k / 4, k % 4), b(k / 4, k % 4), 1e-7);
        }
    }
}

TEST_F(PoseFile, RejectsMalformedLines) {
    expectRefused("", "contains no poses");
    expectRefused("1 2 3\n", ":1: expected 8 numbers");
    expectRefused("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n", ":2: expected 8 numbers");
    expectRefused("0 0 0 0 0 0 0 2\n", ":1: the quaternion is not normalized");
    expectRefused("0 0 nan 0 0 0 0 1\n", ":1: 'nan' is not a finite number");
    expectRefused("0 0 1e999 0 0 0 0 1\n", "is not a finite number");
    expectRefused(std::string("0 0 0 0 0 0 0 1\0002\n", 18), ":1: contains a NUL byte");
    expectRefused("1 0 0 0 0 2 0 0 0 0 1 0\n", ":1: the matrix is not a rigid");
    expectRefused("1 0 0 0 0 1 0 0 0 0 -1 0\n", ":1: the matrix is not a rigid");
    expectRefused("1e200 -1e200 0 100 1e200 1e200 0 50 0 0 1 5\n", ":1: the matrix is not a rigid");
    EXPECT_THAT(test::messageOf([&] { readTumPoses(folder_ / "none"); }), HasSubstr("none"));
    EXPECT_THAT(test::messageOf([&] { readTumPoses(folder_.path()); }),
                HasSubstr("is a folder, not a file"));
}

RawlogSurvey surveyOfTwoScans() {
    RawlogSurvey survey;
    for (const double time_s : {100.0, 100.1}) {
        survey.scans["lidar"].push_back(
            {mrpt::Clock::fromDouble(time_s), CPose3D(0, 0, 0.5, 0, 0, 0)});
    }
    return survey;
}

TEST_F(PoseFile, AssignsKittiPosesToScans) {
    const auto file =
        folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 4 0 1 0 0 0 0 1 0\n");
    const LogPoses poses = posesOfRawlog(surveyOfTwoScans(), file);
    const auto vehicle = poses.vehicle.at(mrpt::Clock::fromDouble(100.1));
    ASSERT_TRUE(vehicle);
    EXPECT_NEAR(vehicle->x(), 4.0, 1e-9);
    EXPECT_NEAR(vehicle->z(), -0.5, 1e-9);  // the sensor is mounted above the origin
    EXPECT_EQ(poses.source, file.string());
}

TEST_F(PoseFile, RejectsKittiPosesAtEqualTimes) {
    const auto file =
        folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 4 0 1 0 0 0 0 1 0\n");
    RawlogSurvey survey = surveyOfTwoScans();
    survey.scans["lidar"][1].time = survey.scans["lidar"][0].time;
    EXPECT_THAT(test::messageOf([&] { posesOfRawlog(survey, file); }),
                HasSubstr("poses.txt: scans 0 and 1 have different poses, but the same time"));
    folder_.write("poses.txt", "1 0 0 4 0 1 0 0 0 0 1 0\n1 0 0 4 0 1 0 0 0 0 1 0\n");
    EXPECT_TRUE(posesOfRawlog(survey, file).are_of_sensor);
    // Scans without times have no poses, so there is no conflict.
    folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 4 0 1 0 0 0 0 1 0\n");
    for (auto& scan : survey.scans["lidar"]) scan.time = INVALID_TIMESTAMP;
    EXPECT_EQ(test::messageOf([&] { posesOfRawlog(survey, file); }), "");
}

TEST_F(PoseFile, RejectsKittiFileWithOtherLength) {
    const auto file = folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    RawlogSurvey survey = surveyOfTwoScans();
    EXPECT_THAT(test::messageOf([&] { posesOfRawlog(survey, file); }),
                HasSubstr("1 pose for 2 scans"));
    survey.scans["rear"] = {};
    EXPECT_THAT(test::messageOf([&] { posesOfRawlog(survey, file); }),
                HasSubstr("scan of a single LiDAR"));
}

TEST_F(PoseFile, PrefersTumPosesFromFolder) {
    folder_.write("velodyne/000000.bin", "");
    folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    const ScanFolder folder(folder_.path());
    EXPECT_EQ(posesOfScanFolder(folder, {0.0}, {}).source, folder.kittiPosesFile());
    folder_.write("poses.tum", "0 1 2 3 0 0 0 1\n");
    const LogPoses poses = posesOfScanFolder(folder, {0.0}, {});
    EXPECT_EQ(poses.source, folder.tumFile());
    EXPECT_NEAR(poses.vehicle.at(mrpt::Clock::fromDouble(0.0)).value().z(), 3.0, 1e-9);
}

TEST_F(PoseFile, AppliesKittiCalibration) {
    // The camera looks along x: its z axis is the LiDAR's x axis, its x axis the LiDAR's -y axis.
    folder_.write("velodyne/000000.bin", "");
    folder_.write("calib.txt", "P0: 1 2 3\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
    folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n");  // 5 m along the camera's z
    const LogPoses poses = posesOfScanFolder(ScanFolder(folder_.path()), {0.0}, {});
    const auto pose = poses.vehicle.at(mrpt::Clock::fromDouble(0.0)).value();
    EXPECT_NEAR(pose.x(), 5.0, 1e-9);
    EXPECT_NEAR(pose.z(), 0.0, 1e-9);
    folder_.write("calib.txt", "P0: 1 2 3\n");
    EXPECT_THAT(test::messageOf([&] { posesOfScanFolder(ScanFolder(folder_.path()), {0.0}, {}); }),
                HasSubstr("no line 'Tr:'"));
}

}  // namespace
}  // namespace hagen::recordings
