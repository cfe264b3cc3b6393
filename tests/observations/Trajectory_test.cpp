#include <gtest/gtest.h>
#include <hagen/observations/RawlogWriter.h>
#include <hagen/observations/Trajectory.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen {
namespace {

using mrpt::poses::CPose3D;

mrpt::Clock::time_point at(double seconds) { return mrpt::Clock::fromDouble(1000.0 + seconds); }

TEST(Trajectory, LiesBetweenTheTwoPosesAroundATime) {
    Trajectory trajectory;
    trajectory.add(at(0.0), CPose3D(1, 0, 2, 0, 0, 0));
    trajectory.add(at(0.1), CPose3D(2, 4, 2, 0.2, 0, 0));
    const auto pose = trajectory.at(at(0.025));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->x(), 1.25, 1e-4);
    EXPECT_NEAR(pose->y(), 1.0, 1e-4);
    EXPECT_NEAR(pose->z(), 2.0, 1e-4);
    EXPECT_NEAR(pose->yaw(), 0.05, 1e-4);
}

TEST(Trajectory, TakesAPoseOfTheVeryTimeAlsoAtBothEnds) {
    Trajectory trajectory;
    trajectory.add(at(0.0), CPose3D(1, 0, 0, 0, 0, 0));
    trajectory.add(at(5.0), CPose3D(2, 0, 0, 0, 0, 0));
    EXPECT_NEAR(trajectory.at(at(0.0)).value().x(), 1.0, 1e-9);
    EXPECT_NEAR(trajectory.at(at(5.0)).value().x(), 2.0, 1e-9);
}

TEST(Trajectory, IsNotKnownBeyondItsEndsNorInItsGaps) {
    EXPECT_FALSE(Trajectory().at(at(0)));
    Trajectory trajectory;
    trajectory.add(at(0.0), CPose3D());
    trajectory.add(at(0.1), CPose3D());
    trajectory.add(at(5.0), CPose3D());
    EXPECT_FALSE(trajectory.at(at(-0.01)));
    EXPECT_FALSE(trajectory.at(at(5.01)));
    EXPECT_FALSE(trajectory.at(at(2.0)));
    EXPECT_TRUE(trajectory.at(at(0.05)));
}

TEST(Trajectory, AGapOfMoreThanAFifthOfASecondIsNotBridged) {
    for (const auto& [gap_s, is_known] : {std::pair{0.19, true}, {0.21, false}}) {
        Trajectory trajectory;
        trajectory.add(at(0.0), CPose3D());
        trajectory.add(at(gap_s), CPose3D());
        EXPECT_EQ(trajectory.at(at(gap_s / 2)).has_value(), is_known) << gap_s;
    }
}

mrpt::obs::CObservationRobotPose::Ptr pose(double seconds, double x_m) {
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->timestamp = at(seconds);
    observation->pose.mean = CPose3D(x_m, 0, 1, 0, 0, 0);
    return observation;
}

TEST(Trajectory, IsReadFromALogAloneAndInFramesWithThePlaceOfWhatTellsIt) {
    const test::TemporaryFolder folder;
    auto frame = mrpt::obs::CSensoryFrame::Create();
    const auto aside = pose(0.1, 3.0);
    aside->sensorPose = CPose3D(0.5, 0, 0, 0, 0, 0);
    frame->insert(aside);
    RawlogWriter writer(folder / "a.rawlog", false);
    writer.write(*pose(0.0, 1.0));
    writer.write(*frame);
    writer.commit();
    const Trajectory trajectory = readTrajectory(folder / "a.rawlog");
    EXPECT_NEAR(trajectory.at(at(0.0)).value().x(), 1.0, 1e-6);
    EXPECT_NEAR(trajectory.at(at(0.1)).value().x(), 2.5, 1e-6);
    EXPECT_NEAR(trajectory.at(at(0.1)).value().z(), 1.0, 1e-6);
}

TEST(Trajectory, OfALogThatBreaksOffHoldsWhatWasBefore) {
    const test::TemporaryFolder folder;
    RawlogWriter writer(folder / "a.rawlog", false);
    for (int i = 0; i < 20; ++i) writer.write(*pose(0.1 * i, i));
    writer.commit();
    const std::string bytes = test::readFile(folder / "a.rawlog");
    const Trajectory trajectory =
        readTrajectory(folder.write("cut.rawlog", bytes.substr(0, bytes.size() / 2)));
    EXPECT_TRUE(trajectory.at(at(0.0)));
    EXPECT_FALSE(trajectory.at(at(1.9)));
    EXPECT_THROW(readTrajectory(folder / "none.rawlog"), std::runtime_error);
}

}  // namespace
}  // namespace hagen
