#include <gtest/gtest.h>
#include <hagen/recordings/RawlogSurvey.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "convert/RawlogWriter.h"
#include "mrpt/Results.h"

#include "support/Program.h"

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;

mrpt::Clock::time_point at(double seconds) { return mrpt::Clock::fromDouble(1000.0 + seconds); }

mrpt::obs::CObservationRobotPose::Ptr pose(double seconds, double x_m,
                                           const std::string& label = "") {
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->timestamp = at(seconds);
    observation->sensorLabel = label;
    observation->pose.mean = CPose3D(x_m, 0, 1, 0, 0, 0);
    return observation;
}

mrpt::obs::CObservationOdometry::Ptr odometry(double seconds, double x_m) {
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->timestamp = at(seconds);
    observation->sensorLabel = "wheels";
    observation->odometry = mrpt::poses::CPose2D(x_m, 0, 0);
    return observation;
}

/// A step forward, then a quarter turn to the left.
mrpt::obs::CActionCollection::Ptr stepAndTurn(mrpt::Clock::time_point time) {
    mrpt::obs::CActionRobotMovement3D movement;
    movement.timestamp = time;
    movement.poseChange.mean = CPose3D(1, 0, 0.5, M_PI / 2, 0, 0);
    auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(movement);
    return actions;
}

mrpt::obs::CSensoryFrame::Ptr frameOf(const mrpt::obs::CObservation::Ptr& observation) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(observation);
    return frame;
}

mrpt::obs::CObservationPointCloud::Ptr cloud(double seconds, const std::string& label) {
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->timestamp = at(seconds);
    observation->sensorLabel = label;
    observation->sensorPose = CPose3D(0, 0, 0.25, 0, 0, 0);
    return observation;
}

mrpt::obs::CObservationPointCloud::Ptr result(double seconds, const std::string& label,
                                              bool is_roi) {
    const auto scan = cloud(seconds, label);
    return observations::resultOf(*scan, is_roi, mrpt::maps::CSimplePointsMap::Create());
}

class RawlogSurveyTest : public testing::Test {
 protected:
    RawlogSurvey survey(const std::vector<mrpt::serialization::CSerializable::Ptr>& entries) {
        convert::RawlogWriter writer(folder_ / "a.rawlog", true);
        for (const auto& entry : entries) writer.write(*entry);
        writer.commit();
        return surveyRawlog(folder_ / "a.rawlog");
    }
    test::TemporaryFolder folder_;
};

TEST_F(RawlogSurveyTest, ReadsRobotPosesWithMount) {
    const auto aside = pose(0.1, 3.0);
    aside->sensorPose = CPose3D(0.5, 0, 0, 0, 0, 0);
    const auto found = survey({pose(0.0, 1.0), frameOf(aside)});
    EXPECT_EQ(found.source, "CObservationRobotPose");
    EXPECT_NEAR(found.trajectory.at(at(0.0)).value().x(), 1.0, 1e-6);
    EXPECT_NEAR(found.trajectory.at(at(0.1)).value().x(), 2.5, 1e-6);
    EXPECT_NEAR(found.trajectory.at(at(0.1)).value().z(), 1.0, 1e-6);
}

TEST_F(RawlogSurveyTest, PrefersLabelWithMorePoses) {
    const auto found = survey({pose(0.0, 1, "gps"), pose(0.0, 7, "slam"), pose(0.1, 8, "slam")});
    EXPECT_EQ(found.source, "CObservationRobotPose 'slam'");
    EXPECT_EQ(found.trajectory.size(), 2u);
    EXPECT_NEAR(found.trajectory.at(at(0.0)).value().x(), 7.0, 1e-6);
}

TEST_F(RawlogSurveyTest, SumsMovements) {
    const auto found = survey({stepAndTurn(at(0.1)), stepAndTurn(at(0.2)), stepAndTurn(at(0.3))});
    EXPECT_EQ(found.source, "CActionRobotMovement3D");
    ASSERT_EQ(found.trajectory.size(), 3u);
    const CPose3D last = found.trajectory.at(at(0.3)).value();  // forward, left, back
    EXPECT_NEAR(last.x(), 0.0, 1e-6);
    EXPECT_NEAR(last.y(), 1.0, 1e-6);
    EXPECT_NEAR(last.z(), 1.5, 1e-6);
}

TEST_F(RawlogSurveyTest, TimesMovementsByNextFrame) {
    const auto found = survey({frameOf(cloud(0.0, "lidar")), stepAndTurn(INVALID_TIMESTAMP),
                               frameOf(cloud(0.1, "lidar")), stepAndTurn(INVALID_TIMESTAMP)});
    ASSERT_EQ(found.trajectory.size(), 2u);
    EXPECT_NEAR(found.trajectory.at(at(0.0)).value().x(), 0.0, 1e-6);
    EXPECT_NEAR(found.trajectory.at(at(0.1)).value().x(), 1.0, 1e-6);
}

TEST_F(RawlogSurveyTest, PrefersOtherSourcesTo2dMovements) {
    auto actions = mrpt::obs::CActionCollection::Create();
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = at(0.1);
    movement.computeFromOdometry(mrpt::poses::CPose2D(2, 1, 0), {});
    actions->insert(movement);
    const auto alone = survey({actions});
    EXPECT_EQ(alone.source, "CActionRobotMovement2D");
    EXPECT_NEAR(alone.trajectory.at(at(0.1)).value().y(), 1.0, 1e-6);
    EXPECT_EQ(survey({actions, odometry(0.1, 5)}).source, "CObservationOdometry 'wheels'");
}

TEST_F(RawlogSurveyTest, PrefersSourceOverCount) {
    EXPECT_EQ(survey({odometry(0.0, 5), odometry(0.1, 6), odometry(0.2, 6), stepAndTurn(at(0.1)),
                      stepAndTurn(at(0.2)), pose(0.0, 1)})
                  .source,
              "CObservationRobotPose");
    EXPECT_EQ(survey({odometry(0.0, 5), odometry(0.1, 6), stepAndTurn(at(0.1))}).source,
              "CActionRobotMovement3D");
    const auto odometry_alone = survey({odometry(0.0, 5), odometry(0.1, 6)});
    EXPECT_NEAR(odometry_alone.trajectory.at(at(0.1)).value().x(), 6.0, 1e-6);
}

TEST_F(RawlogSurveyTest, ReturnsNoPosesWithoutSource) {
    const auto found = survey({cloud(0.0, "lidar"), frameOf(cloud(0.1, "lidar"))});
    EXPECT_EQ(found.source, "");
    EXPECT_EQ(found.trajectory.size(), 0u);
}

TEST_F(RawlogSurveyTest, ListsScansBySensorLabel) {
    const auto found =
        survey({cloud(0.0, "front"), result(0.0, "front", true), result(0.0, "front", false),
                frameOf(cloud(0.05, "rear")), cloud(0.1, "front")});
    ASSERT_EQ(found.scans.size(), 2u);
    ASSERT_EQ(found.scans.at("front").size(), 2u);
    EXPECT_EQ(found.scans.at("front")[1].time, at(0.1));
    EXPECT_NEAR(found.scans.at("rear")[0].sensor_on_vehicle.z(), 0.25, 1e-6);
}

TEST_F(RawlogSurveyTest, KeepsPosesBeforeTruncation) {
    std::vector<mrpt::serialization::CSerializable::Ptr> poses;
    for (int i = 0; i < 20; ++i) poses.push_back(pose(0.1 * i, i));
    survey(poses);
    const std::string bytes = test::readFile(folder_ / "a.rawlog");
    const auto found = surveyRawlog(folder_.write("cut.rawlog", bytes.substr(0, bytes.size() / 2)));
    EXPECT_TRUE(found.trajectory.at(at(0.0)));
    EXPECT_FALSE(found.trajectory.at(at(1.9)));
    EXPECT_THROW(surveyRawlog(folder_ / "none.rawlog"), std::runtime_error);
}

TEST_F(RawlogSurveyTest, StopsOnRequest) {
    survey({pose(0.0, 1), pose(0.1, 2), pose(0.2, 3)});
    int entries = 0;
    const auto found = surveyRawlog(folder_ / "a.rawlog", [&] { return ++entries <= 2; });
    EXPECT_EQ(found.trajectory.size(), 2u);
}

}  // namespace
}  // namespace hagen::recordings
