#include <gtest/gtest.h>
#include <hagen/avoidance/Guidance.h>

#include "support/SolidWorld.h"

namespace hagen::avoidance {
namespace {

using test::SolidWorld;

GuidanceTask eastwards() {
    GuidanceTask task;
    task.position_m = {0, 0, 2};
    task.goal_m = {40, 0, 2};
    task.bounds_m = {Eigen::Vector3d(-5, -20, 0), Eigen::Vector3d(45, 20, 6)};
    return task;
}

Carrot carrot(const std::string& guidance, const SolidWorld& world, const GuidanceTask& task) {
    return makeGuidance(guidance)->carrot(world, task);
}

TEST(Guidance, StraightHeadsForGoal) {
    GuidanceTask task = eastwards();
    task.ground_m = 3;
    task.altitude_m = 2.5;
    task.goal_m.z() = 8;
    const Carrot far_off = carrot("straight", {}, task);
    EXPECT_EQ(far_off.at_m, Eigen::Vector3d(40, 0, 5.5));
    EXPECT_TRUE(far_off.path_m.empty());
    EXPECT_EQ(far_off.beyond_m, 0);
    task.position_m = {38, 0, 5};
    task.goal_m.z() = 6;
    EXPECT_EQ(carrot("straight", {}, task).at_m, Eigen::Vector3d(40, 0, 6));
}

TEST(Guidance, PathThroughEmptySpaceIsStraight) {
    GuidanceTask task = eastwards();
    const Carrot ahead = carrot("astar", {}, task);
    EXPECT_TRUE(ahead.at_m.isApprox(Eigen::Vector3d(4, 0, 2), 1e-9));
    EXPECT_NEAR(ahead.beyond_m, 36, 1e-9);
    task.goal_m = {40, 17, 2};  // the path has 45 degree bends, the carrot does not
    const Eigen::Vector3d at_m = carrot("astar", {}, task).at_m;
    EXPECT_NEAR(at_m.norm(), std::sqrt(16 + 4), 0.3);
}

/// The grid path turns by 45 degrees. The straight line to the goal is midway between two rows
/// of posts.
TEST(Guidance, CutsCornersWithClearance) {
    constexpr float kRoom_m = 1.4f, kPost_m = 0.2f;
    const Eigen::Vector2f along = Eigen::Vector2f(2, 1).normalized();
    const Eigen::Vector2f across(-along.y(), along.x());
    SolidWorld world;
    for (float at_m = -2; at_m < 16; at_m += 0.25f) {
        for (const float side : {-1.0f, 1.0f}) {
            world.trunk(at_m * along + side * (kRoom_m + kPost_m) * across, kPost_m);
        }
    }
    GuidanceTask task = eastwards();
    task.goal_m = {40, 20, 2};
    const Eigen::Vector3d ahead_m = carrot("astar", world, task).at_m - task.position_m;
    EXPECT_NEAR(ahead_m.norm(), 4, 1e-9);
    EXPECT_LT(std::abs(ahead_m.head<2>().dot(across.cast<double>())), 0.25);
}

TEST(Guidance, CarrotEndsAtGoal) {
    GuidanceTask task = eastwards();
    task.position_m = {37, 0, 2};
    const Carrot near = carrot("astar", {}, task);
    EXPECT_EQ(near.at_m, task.goal_m);
    EXPECT_NEAR(near.beyond_m, 0, 1e-9);
}

/// Planners fly straight to the carrot, so no bend may hide it.
TEST(Guidance, CarrotStaysVisible) {
    SolidWorld world;  // an S-bend between two walls, 2.2 m wide
    world.box({2, -20, -10}, {2.4f, 0.7f, 20}).box({4.6f, -0.7f, -10}, {5, 20, 20});
    GuidanceTask task = eastwards();
    for (const double y_m : {-0.5, 0.0, 0.8}) {
        task.position_m = {0.8, y_m, 2};
        const Carrot behind = carrot("astar", world, task);
        ASSERT_GT(behind.path_m.size(), 2u);
        const Eigen::Vector3d offset_m = behind.at_m - task.position_m;
        EXPECT_GT(offset_m.norm(), 0.9);
        for (double share = 0; share <= 1; share += 0.02) {
            const Eigen::Vector3d at_m = task.position_m + share * offset_m;
            EXPECT_GE(world.clearance_m(at_m.cast<float>()), 0.6) << y_m << " " << share;
        }
    }
}

TEST(Guidance, PathLeadsAroundWall) {
    SolidWorld world;
    world.box({6, -15, -10}, {7, 5, 20});
    const Carrot around = carrot("astar", world, eastwards());
    EXPECT_GT(around.at_m.y(), 1.5);
    EXPECT_NEAR((around.at_m - Eigen::Vector3d(0, 0, 2)).norm(), 4, 0.5);
    EXPECT_GT(around.path_m.size(), 50u);
    EXPECT_EQ(around.path_m.front(), Eigen::Vector3d(0, 0, 2));
    EXPECT_EQ(around.path_m.back(), eastwards().goal_m);
}

TEST(Guidance, PathKeepsAltitudeLimits) {
    SolidWorld world;
    world.box({6, -30, -10}, {7, 30, 3.5f});  // flying over it requires 4.15 m
    GuidanceTask task = eastwards();
    double highest_m = 0;
    for (const auto& at : carrot("astar", world, task).path_m) {
        highest_m = std::max(highest_m, at.z());
    }
    EXPECT_GT(highest_m, 4.1);
    EXPECT_LE(highest_m, 4.5);
    task.highest_m = 4.0;
    EXPECT_TRUE(carrot("astar", world, task).path_m.empty());
}

TEST(Guidance, ReplacesBlockedGoal) {
    GuidanceTask task = eastwards();
    const SolidWorld world = SolidWorld().trunk({40, 0}, 0.3f);
    const Carrot beside = carrot("astar", world, task);
    ASSERT_FALSE(beside.path_m.empty());
    const double off_m = (beside.path_m.back() - task.goal_m).norm();
    EXPECT_GT(off_m, 0.94);
    EXPECT_LT(off_m, 1.2);
    task.goal_m = {60, 0, 2};
    const Carrot inside = carrot("astar", {}, task);
    ASSERT_FALSE(inside.path_m.empty());
    EXPECT_EQ(inside.path_m.back(), Eigen::Vector3d(45, 0, 2));
}

TEST(Guidance, HeadsStraightWithoutPath) {
    SolidWorld world;
    world.box({6, -30, -10}, {7, 30, 20});
    const Carrot none = carrot("astar", world, eastwards());
    EXPECT_TRUE(none.path_m.empty());
    EXPECT_EQ(none.at_m, eastwards().goal_m);
    EXPECT_EQ(none.beyond_m, 0);
}

TEST(Guidance, RejectsUnknownNames) { EXPECT_THROW(makeGuidance("rrt"), std::invalid_argument); }

}  // namespace
}  // namespace hagen::avoidance
