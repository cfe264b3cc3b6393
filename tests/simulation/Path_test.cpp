#include <gtest/gtest.h>
#include <hagen/simulation/Path.h>

#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

TEST(PathTest, IsClosed) {
    const Path path{30, 10};
    EXPECT_NEAR((path.at(0) - Eigen::Vector2d(0, -10)).norm(), 0, 1e-12);
    EXPECT_NEAR((path.at(path.length_m()) - path.at(0)).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(path.length_m() / 2) - Eigen::Vector2d(0, 10)).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(-5) - Eigen::Vector2d(-5, -10)).norm(), 0, 1e-9);
}

TEST(PathTest, FollowsHeading) {
    const Path path{12, 7};
    constexpr double kStep_m = 1e-4;
    for (double way_m = 0.05; way_m < 2 * path.length_m(); way_m += 0.37) {
        const Eigen::Vector2d step = path.at(way_m + kStep_m) - path.at(way_m);
        const double heading = path.heading_rad(way_m);
        EXPECT_NEAR(step.x() / kStep_m, std::cos(heading), 1e-3) << way_m;
        EXPECT_NEAR(step.y() / kStep_m, std::sin(heading), 1e-3) << way_m;
    }
}

TEST(PathTest, DistanceMatchesBruteForce) {
    const Path path{12, 7};
    for (const Eigen::Vector2d& place :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 20), Eigen::Vector2d(25, 4),
          Eigen::Vector2d(-14, -3), Eigen::Vector2d(12, -7)}) {
        double nearest_m = 1e9;
        for (double way_m = 0; way_m < path.length_m(); way_m += 0.01) {
            nearest_m = std::min(nearest_m, (path.at(way_m) - place).norm());
        }
        EXPECT_NEAR(path.distance_m(place.x(), place.y()), nearest_m, 0.01) << place.transpose();
    }
}

}  // namespace
}  // namespace hagen::simulation
