#include <gtest/gtest.h>
#include <hagen/mrpt/Trajectory.h>

#include <cmath>
#include <limits>

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;

mrpt::Clock::time_point at(double seconds) { return mrpt::Clock::fromDouble(1000.0 + seconds); }

TEST(Trajectory, InterpolatesLinearly) {
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

TEST(Trajectory, ReturnsExactPoses) {
    Trajectory trajectory;
    trajectory.add(at(0.0), CPose3D(1, 0, 0, 0, 0, 0));
    trajectory.add(at(5.0), CPose3D(2, 0, 0, 0, 0, 0));
    EXPECT_NEAR(trajectory.at(at(0.0)).value().x(), 1.0, 1e-9);
    EXPECT_NEAR(trajectory.at(at(5.0)).value().x(), 2.0, 1e-9);
}

TEST(Trajectory, IsUndefinedOutsideAndInGaps) {
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

TEST(Trajectory, CountsNonFinitePoses) {
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    Trajectory trajectory;
    trajectory.add(at(0.0), CPose3D(1, 0, 0, 0, 0, 0));
    trajectory.add(at(0.05), CPose3D(nan, 0, 0, 0, 0, 0));
    trajectory.add(at(0.05), CPose3D(0, 0, infinite, 0, 0, 0));
    trajectory.add(at(0.05), CPose3D(0, 0, 0, 0, nan, 0));
    trajectory.add(at(0.1), CPose3D(2, 0, 0, 0, 0, 0));
    EXPECT_NEAR(trajectory.at(at(0.05)).value().x(), 1.5, 1e-4);
    EXPECT_EQ(trajectory.size(), 2u);
    EXPECT_EQ(trajectory.not_finite, 3u);
}

TEST(Trajectory, BridgesGapsUpTo200ms) {
    for (const auto& [gap_s, is_known] : {std::pair{0.19, true}, {0.21, false}}) {
        Trajectory trajectory;
        trajectory.add(at(0.0), CPose3D());
        trajectory.add(at(gap_s), CPose3D());
        EXPECT_EQ(trajectory.at(at(gap_s / 2)).has_value(), is_known) << gap_s;
    }
}

}  // namespace
}  // namespace hagen::observations
