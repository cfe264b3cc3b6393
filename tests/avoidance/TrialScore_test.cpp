#include "avoidance/flights/TrialScore.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "avoidance/SimpleCourse.h"

namespace hagen::avoidance {
namespace {

using test::emptyContent;
using test::putWall;
using test::simpleCourse;

TEST(TrialJudge, CollisionPrecedesGoal) {
    const Course course = simpleCourse(emptyContent());
    TrialJudge judge(course, 4);
    EXPECT_EQ(judge.judge({20, 0, 2}, 0.29, 0.3, 1), Outcome::Collision);
    EXPECT_EQ(judge.judge({18.6, 0, 2}, 0.31, 0.3, 1), Outcome::Success);
    EXPECT_EQ(judge.judge({18.4, 0, 2}, 2, 0.3, 1), std::nullopt);
}

TEST(TrialJudge, TimesOutWithoutProgress) {
    const Course course = simpleCourse(emptyContent());
    TrialJudge judge(course, 4);  // stalling is limited to 20 / 4 + 10 s
    EXPECT_EQ(judge.judge({5, 0, 2}, 2, 0.3, 2), std::nullopt);
    EXPECT_EQ(judge.judge({4, 0, 2}, 2, 0.3, 16.9), std::nullopt);
    EXPECT_EQ(judge.judge({5.5, 0, 2}, 2, 0.3, 17.1), Outcome::Timeout);
    TrialJudge other(course, 4);
    EXPECT_EQ(other.judge({5, 12.9, 2}, 2, 0.3, 2), std::nullopt);
    EXPECT_EQ(other.judge({5, 13.1, 2}, 2, 0.3, 2), Outcome::Timeout);
}

TEST(TrialJudge, LimitsFlightTime) {
    const Course course = simpleCourse(emptyContent());
    TrialJudge judge(course, 4);
    for (double time_s = 0; time_s < 34.9; time_s += 5) {  // slightly more than 1 m per 5 s
        EXPECT_EQ(judge.judge({time_s / 4, 0, 2}, 2, 0.3, time_s), std::nullopt) << time_s;
    }
    EXPECT_EQ(judge.judge({12, 0, 2}, 2, 0.3, 35.1), Outcome::Timeout);
    EXPECT_EQ(TrialJudge::longestFlight_s(course, 4), 35);
}

TEST(FreeDistance, EndsAtObstacle) {
    simulation::SceneContent content = emptyContent();
    EXPECT_TRUE(std::isnan(freeDistance_m(simpleCourse(content), {0, 0, 2}, 0.65, 0)));
    putWall(content, -5, 5);
    const Course course = simpleCourse(std::move(content));
    EXPECT_NEAR(freeDistance_m(course, {0, 0, 2}, 0.65, 0), 10 - 0.65, 0.06);
    EXPECT_NEAR(freeDistance_m(course, {9.5, 0, 2}, 0.65, 0), 0, 1e-9);
    EXPECT_TRUE(std::isnan(freeDistance_m(course, {12, 0, 2}, 0.65, 0)));
}

TEST(LeavesCourse, DetectsTurnsAndBraking) {
    const Eigen::Vector3d ahead(20, 0, 0);
    const auto towards = [](double angle_deg, double speed) {
        return Eigen::Vector3d(speed * std::cos(radians(angle_deg)),
                               speed * std::sin(radians(angle_deg)), 0);
    };
    EXPECT_FALSE(leavesCourse(towards(14, 4), ahead, 4));
    EXPECT_TRUE(leavesCourse(towards(16, 4), ahead, 4));
    EXPECT_FALSE(leavesCourse(towards(0, 2.9), ahead, 4));
    EXPECT_TRUE(leavesCourse(towards(0, 2.7), ahead, 4));
    EXPECT_TRUE(leavesCourse(Eigen::Vector3d::Zero(), ahead, 4));
}

}  // namespace
}  // namespace hagen::avoidance
