#include <gtest/gtest.h>
#include <hagen/avoidance/Planner.h>

#include "support/Random.h"
#include "support/SmallFlight.h"

namespace hagen::avoidance {
namespace {

using test::fly;
using test::SmallFlight;
using test::SmallFlightResult;
using test::SolidWorld;

/// An airborne task: eastwards at 2 m altitude to a distant goal.
PlanningTask flyingEast(double speed_m_s = 0) {
    PlanningTask task;
    task.start.position_m = {0, 0, 2};
    task.start.velocity_m_s = {speed_m_s, 0, 0};
    task.carrot_m = {40, 0, 2};
    return task;
}

class Planners : public testing::TestWithParam<std::string> {
 protected:
    Plan plan(const SolidWorld& world, const PlanningTask& task) const {
        return makePlanner(GetParam())->plan(world, task);
    }
    SmallFlight flight() const {
        SmallFlight flight;
        flight.planner = GetParam();
        return flight;
    }
};
INSTANTIATE_TEST_SUITE_P(All, Planners, testing::ValuesIn(plannerNames()),
                         [](const auto& name) { return name.index ? "Histogram" : "Primitives"; });

TEST_P(Planners, FlyStraightInEmptySpace) {
    for (double speed_m_s : {0.0, 4.0}) {
        const Plan made = plan({}, flyingEast(speed_m_s));
        EXPECT_TRUE(made.command_m_s.isApprox(Eigen::Vector3d(4, 0, 0), 1e-9));
        EXPECT_FALSE(made.is_emergency);
    }
}

TEST_P(Planners, SlowDownForGoalOnly) {
    PlanningTask task = flyingEast(4);
    task.carrot_m = {1, 0, 2};
    EXPECT_LT(plan({}, task).command_m_s.norm(), 2.1);
    task.beyond_carrot_m = 30;
    EXPECT_NEAR(plan({}, task).command_m_s.x(), 4, 1e-9);
}

TEST_P(Planners, SettleAtGoal) {
    SmallFlight straight = flight();
    straight.goal_m = {10, 3, 2.5};
    const SmallFlightResult flown = fly(SolidWorld().ground(0), straight);
    EXPECT_TRUE(flown.arrived);
    EXPECT_LT(flown.end.velocity_m_s.norm(), 3);
}

TEST_P(Planners, ClimbToCarrot) {
    PlanningTask task = flyingEast(4);
    task.carrot_m.z() = 2.6;
    EXPECT_GT(plan({}, task).command_m_s.z(), 0.3);
    task.carrot_m.z() = 1.4;
    EXPECT_LT(plan({}, task).command_m_s.z(), -0.3);
}

TEST_P(Planners, KeepAltitudeLimits) {
    // The wall has no way around, and the altitude limits prevent flying over it.
    SolidWorld world;
    world.ground(0).box({12, -40, 0}, {12.5f, 40, 5});
    SmallFlight over = flight();
    over.longest_s = 15;
    const SmallFlightResult flown = fly(world, over);
    EXPECT_FALSE(flown.arrived);
    EXPECT_LT(flown.end.position_m.z(), 4.7);
    EXPECT_GT(flown.min_m, 0.45);
}

TEST_P(Planners, FlyAroundTrunk) {
    const SmallFlightResult flown = fly(SolidWorld().trunk({15, 0.1f}, 0.3f), flight());
    EXPECT_TRUE(flown.arrived);
    EXPECT_GT(flown.min_m, 0.6);
    EXPECT_LT(flown.path_m, 42);
    EXPECT_EQ(flown.emergencies, 0);
}

/// A wall across the path with a single gap beside the straight line.
SolidWorld wallWithGap(float width_m) {
    SolidWorld world;
    world.box({20, -100, -100}, {20.2f, 1 - width_m / 2, 100});
    return world.box({20, 1 + width_m / 2, -100}, {20.2f, 100, 100});
}

TEST_P(Planners, PassOnlyWideGaps) {
    SmallFlight through = flight();
    through.guidance = "astar";
    const SmallFlightResult wide = fly(wallWithGap(1.6f), through);
    EXPECT_TRUE(wide.arrived);
    EXPECT_GT(wide.min_m, 0.6);
    through.longest_s = 8;
    const SmallFlightResult narrow = fly(wallWithGap(1.25f), through);
    EXPECT_FALSE(narrow.arrived);
    EXPECT_LT(narrow.end.position_m.x(), 20);
    EXPECT_GT(narrow.min_m, 0.6);
}

TEST_P(Planners, MoveAwayFromNearObstacle) {
    SolidWorld world;
    world.box({0.5f, -100, -100}, {1.5f, 100, 100});
    PlanningTask task = flyingEast();
    task.carrot_m = {-20, 0, 2};
    const Plan away = plan(world, task);
    EXPECT_LT(away.command_m_s.x(), -1);
    task.carrot_m = {20, 0, 2};  // behind the obstacle
    EXPECT_LE(plan(world, task).command_m_s.x(), 0.1);
}

TEST_P(Planners, BrakeWhenEnclosed) {
    SolidWorld world;
    world.sphere({0, 0, 2}, 50);
    PlanningTask task = flyingEast(2);
    const Plan braked = plan(world, task);
    EXPECT_EQ(braked.command_m_s, Eigen::Vector3d(0, 0, 0));
    EXPECT_TRUE(braked.is_emergency);
}

TEST_P(Planners, BrakeNearContact) {
    SolidWorld world;
    world.box({2.2f, -100, -100}, {3, 100, 100});
    const Plan made = plan(world, flyingEast(4));
    EXPECT_TRUE(made.is_emergency);
    EXPECT_EQ(made.command_m_s, Eigen::Vector3d(0, 0, 0));
}

TEST_P(Planners, StayInKnownSpace) {
    SolidWorld world;
    world.knownWithin({Eigen::Vector3f(-5, -9, -5), Eigen::Vector3f(14, 9, 10)});
    SmallFlight careful = flight();
    careful.goal_m = {30, 0, 2};
    careful.longest_s = 12;
    EXPECT_TRUE(fly(world, careful).arrived);
    careful.brakes_in_known_space = true;
    const SmallFlightResult flown = fly(world, careful);
    EXPECT_GT(flown.end.position_m.x(), 12);
    EXPECT_LT(flown.end.position_m.x(), 14);
}

TEST_P(Planners, AvoidCrossingObstacle) {
    // A ball crosses the path on a collision course.
    for (float ball_m_s : {0.4f, 0.8f}) {
        SolidWorld world;
        SmallFlight crossing = flight();
        crossing.moves = [&](double time_s) {
            const auto passed_s = static_cast<float>(time_s) - 5.3f;
            world = SolidWorld().sphere({20, ball_m_s * passed_s, 2}, 0.5f);
        };
        const SmallFlightResult flown = fly(world, crossing);
        EXPECT_TRUE(flown.arrived);
        EXPECT_GT(flown.min_m, 0.3) << ball_m_s;
    }
}

/// A dead end across the straight path, open towards the start.
SolidWorld trap() {
    SolidWorld world;
    world.ground(0).box({20, -5, 0}, {20.3f, 5, 9});
    world.box({13, -5.3f, 0}, {20.3f, -5, 9});
    return world.box({13, 5, 0}, {20.3f, 5.3f, 9});
}

TEST_P(Planners, LeaveTrapAlongPath) {
    SmallFlight trapped = flight();
    trapped.start_m = {17, 0, 2};
    trapped.longest_s = 15;
    const SmallFlightResult straight = fly(trap(), trapped);
    EXPECT_FALSE(straight.arrived);
    EXPECT_GT(straight.min_m, 0.6);
    trapped.guidance = "astar";
    trapped.longest_s = 60;
    const SmallFlightResult led = fly(trap(), trapped);
    EXPECT_TRUE(led.arrived);
    EXPECT_GT(led.min_m, 0.6);
}

TEST_P(Planners, NeverCollideWithPerfectKnowledge) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        test::Random random(seed);
        SmallFlight among = flight();
        among.goal_m = {25, 0, 2};
        among.speed_m_s = random.real(2, 8);
        among.latency_s = seed % 2 ? 0.1 : 0;
        among.longest_s = 10;
        SolidWorld world;
        world.ground(0);
        for (int i = 0; i < 40; ++i) {
            const float x = random.real(3, 23), y = random.real(-6, 6), z = random.real(0, 5);
            world.sphere({x, y, z}, random.real(0.05f, 0.8f));
        }
        const SmallFlightResult flown = fly(world, among);
        EXPECT_GT(flown.min_m, VehicleLimits{}.radius_m) << "seed " << seed;
    }
}

TEST_P(Planners, AreDeterministic) {
    test::Random random(3);
    const SolidWorld world = test::forest(random, 0.1, SmallFlight{});
    PlanningTask task = flyingEast(3);
    const Plan first = plan(world, task);
    EXPECT_EQ(first.command_m_s, plan(world, task).command_m_s);
    EXPECT_TRUE(first.candidates.empty());
    task.keeps_candidates = true;
    const Plan kept = plan(world, task);
    EXPECT_EQ(first.command_m_s, kept.command_m_s);
    ASSERT_FALSE(kept.candidates.empty());
    for (const CandidateMotion& motion : kept.candidates) {  // each ends at rest
        EXPECT_TRUE(motion.path_m.front().isApprox(Eigen::Vector3f(0, 0, 2)));
        EXPECT_LT((motion.path_m.back() - motion.path_m[motion.path_m.size() - 2]).norm(), 0.005f);
    }
}

TEST(MustStop, DependsOnStoppingDistance) {
    // From 4 m/s at 5 m/s^2, stopping takes slightly more than 1.6 m; one period covers 0.4 m.
    const auto stopsBefore = [](float wall_m) {
        SolidWorld world;
        world.box({wall_m, -100, -100}, {wall_m + 1, 100, 100});
        return mustStop(world, flyingEast(4));
    };
    EXPECT_TRUE(stopsBefore(2.4f));  // needs at least 0.4 + 1.6 + 0.45 = 2.45 m
    EXPECT_FALSE(stopsBefore(3.0f));
    EXPECT_FALSE(mustStop(SolidWorld().sphere({0.5f, 0, 2}, 0.2f), flyingEast(0)));
}

}  // namespace
}  // namespace hagen::avoidance
