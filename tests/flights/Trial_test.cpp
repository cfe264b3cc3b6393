#include <gtest/gtest.h>
#include <hagen/avoidance/Trial.h>
#include "avoidance/flights/Calibration.h"
#include "avoidance/flights/RunTable.h"

#include <cmath>
#include <stdexcept>

#include "avoidance/SimpleCourse.h"

namespace hagen::avoidance {
namespace {

using test::emptyContent;
using test::putWall;
using test::simpleCourse;

std::string textOf(const TrialResult& result) {
    hagen::avoidance::Run run{};
    run.result = result;
    return rowOf(run);
}

TEST(Trial, FliesStraightOverOpenGround) {
    const Course course = simpleCourse(emptyContent());
    for (const char* model : {"oracle", "W-RoI"}) {
        TrialSetup setup;
        setup.model = model;
        setup.air = Air::Clear;
        const TrialResult result = runTrial(course, setup, constantProfile(10));
        EXPECT_EQ(result.outcome, Outcome::Success) << model;
        EXPECT_NEAR(result.path_m, 18.5, 0.2);  // the flight ends near the goal
        EXPECT_NEAR(result.min_clearance_m, 2, 0.35);
        EXPECT_TRUE(std::isnan(result.first_reaction_m));
        EXPECT_EQ(result.emergency_stops, 0);
        // At 4 m/s, after 0.15 s of latency and about 0.8 s of acceleration.
        EXPECT_GT(result.time_s, 18.5 / 4);
        EXPECT_LT(result.time_s, 18.5 / 4 + 2);
    }
}

/// On a diagonal course, the first reaction must be to the wall, not to the start.
TEST(Trial, FirstReactionIsToObstacle) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -2.5f, 2.5f);
    Course course = simpleCourse(std::move(content));
    course.start_m.y() = -8;
    course.goal_m.y() = 8;
    TrialSetup setup;
    setup.model = "oracle";
    const TrialResult result = runTrial(course, setup, constantProfile(10));
    EXPECT_EQ(result.outcome, Outcome::Success);
    const double to_wall_m = std::hypot(10, 8);
    EXPECT_GT(result.first_reaction_m, 1);
    EXPECT_LT(result.first_reaction_m, to_wall_m - 3);
}

TEST(Trial, ConfiguresWorldModel) {
    const Course course = simpleCourse(emptyContent());
    TrialSetup setup;
    setup.speed_m_s = 3;
    setup.distance = ModelDistance::AsStored;
    WorldModelSetting told;
    setup.make_world = [&](const auto& world) -> std::unique_ptr<WorldModel> {
        told = world;
        throw std::runtime_error("that is enough");
    };
    EXPECT_THROW(runTrial(course, setup, constantProfile(10)), std::runtime_error);
    EXPECT_EQ(told.bounds_m.min(), course.bounds_m.min().cast<float>());
    EXPECT_EQ(told.bounds_m.max(), course.bounds_m.max().cast<float>());
    EXPECT_EQ(told.distance, ModelDistance::AsStored);
    EXPECT_EQ(told.pace.speed_m_s, 3);
}

TEST(Trial, LatencySumsRequiredStages) {
    const Course course = simpleCourse(emptyContent());
    TrialSetup setup;
    setup.model = "W-RoI";
    EXPECT_NEAR(runTrial(course, setup, constantProfile(10)).latency_max_ms, 40, 1e-6);
    setup.model = "W-Full";  // this model needs no filter
    const TrialResult full = runTrial(course, setup, constantProfile(10));
    EXPECT_NEAR(full.latency_p50_ms, 30, 1e-6);
    EXPECT_EQ(full.dropped_scans, 0);
    setup.latency_scale = 2;
    EXPECT_NEAR(runTrial(course, setup, constantProfile(10)).latency_p95_ms, 60, 1e-6);
}

TEST(Trial, BusyPlannerUsesNewestScan) {
    const Course course = simpleCourse(emptyContent());
    TrialSetup setup;
    setup.model = "oracle";
    setup.speed_m_s = 1;
    std::vector<double> given_s;
    TrialListener listener;
    listener.step = [&](const TrialStep& step) { given_s.push_back(step.time_s); };
    // Three stages take 80 ms each: a plan every 240 ms, for the newest of 2 or 3 scans.
    const TrialResult result = runTrial(course, setup, constantProfile(80), nullptr, listener);
    ASSERT_GT(given_s.size(), 20u);
    for (std::size_t i = 1; i < given_s.size(); ++i) {
        EXPECT_NEAR(given_s[i] - given_s[i - 1], 0.24, 1e-6);
    }
    EXPECT_NEAR(result.dropped_scans, result.scans * (1 - 100.0 / 240), 2);
    EXPECT_GE(result.latency_p50_ms, 240 - 1e-6);
    EXPECT_LE(result.latency_max_ms, 340 + 1e-6);
}

TEST(Trial, StopsAtWall) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -40, 40);
    const Course course = simpleCourse(std::move(content));
    for (const auto& [model, updates] :
         {std::pair("W-RoI", Updates::Scans), std::pair("W-Full", Updates::Scans),
          std::pair("oracle", Updates::Scans), std::pair("W-RoI", Updates::Sectors),
          std::pair("R-Full-0.2", Updates::Sectors)}) {
        TrialSetup setup;
        setup.model = model;
        setup.guidance = "straight";
        setup.updates = updates;
        const TrialResult result = runTrial(course, setup, constantProfile(10));
        EXPECT_EQ(result.outcome, Outcome::Timeout) << model;
        EXPECT_GT(result.min_clearance_m, 0.5) << model;
        // The wall is 10 m ahead of the start.
        EXPECT_GT(result.first_reaction_m, 0.5) << model;
        EXPECT_LT(result.first_reaction_m, 10) << model;
    }
}

TEST(Trial, FliesAroundWall) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -4, 4);
    const Course course = simpleCourse(std::move(content));
    TrialSetup setup;
    const TrialResult result = runTrial(course, setup, constantProfile(10));
    EXPECT_EQ(result.outcome, Outcome::Success);
    EXPECT_GT(result.path_m, 18.5 + 1);  // at least 2 hypot(10, 4.5) - 20, minus the goal radius
    EXPECT_GT(result.min_clearance_m, 0.3);
}

TEST(Trial, LateBrakingCollides) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -40, 40);
    const Course course = simpleCourse(std::move(content));
    TrialSetup setup;
    setup.guidance = "straight";
    setup.model = "oracle";
    setup.speed_m_s = 8;
    LatencyProfile profile =
        constantProfile(1);  // half of the plans take seconds, far above the median
    profile.quantiles_ms["oracle/update"] = {1, 1, 20000};
    const TrialResult result = runTrial(course, setup, profile);
    EXPECT_EQ(result.outcome, Outcome::Collision);
    EXPECT_LT(result.min_clearance_m, 0.3);
}

TEST(Trial, AccountsForKnownLatency) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -40, 40);
    TrialSetup setup;
    setup.latency_scale = 100;  // each plan takes 3 s, which the planner takes into account
    setup.guidance = "straight";
    setup.model = "oracle";
    setup.speed_m_s = 8;
    const Course course = simpleCourse(std::move(content));
    EXPECT_NE(runTrial(course, setup, constantProfile(10)).outcome, Outcome::Collision);
}

TEST(Trial, SectorsArePlannedAtFiftyHertz) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -4, 4);
    const Course course = simpleCourse(std::move(content));
    TrialSetup setup;
    setup.updates = Updates::Sectors;
    double turns = 0, last_s = 0;
    TrialListener listener;
    listener.step = [&](const TrialStep& step) {
        const double expected_s = turns == 0 ? 0.104 : last_s + 0.02;  // four stages of 1 ms
        EXPECT_NEAR(step.time_s, expected_s, 1e-9);
        last_s = step.time_s;
        turns += step.scan.turns;
        EXPECT_NEAR(turns, 10 * step.scan.time_s, 1e-3);
        EXPECT_LE(step.scan.time_s, step.time_s - 0.004 + 1e-9);
        // One or two packets are not complete yet, and up to two wait for a third.
        EXPECT_GE(step.scan.time_s, step.time_s - 0.004 - 0.0054);
        EXPECT_NEAR(step.latency_ms, 1e3 * (step.time_s - step.scan.time_s), 1e-6);
    };
    const TrialResult result = runTrial(course, setup, constantProfile(1), nullptr, listener);
    EXPECT_EQ(result.outcome, Outcome::Success);
    EXPECT_EQ(result.dropped_scans, 0);
    EXPECT_NEAR(result.scans, 25 * result.time_s / 0.1, 0.5 * result.time_s / 0.1);
    EXPECT_EQ(textOf(result), textOf(runTrial(course, setup, constantProfile(1))));
}

TEST(Trial, BusyPlannerUsesAllSectors) {
    const Course course = simpleCourse(emptyContent());
    for (const char* model : {"W-Full", "R-Full-0.2", "oracle"}) {
        TrialSetup setup;
        setup.model = model;
        setup.updates = Updates::Sectors;
        double turns = 0, last_s = 0;
        TrialListener listener;
        listener.step = [&](const TrialStep& step) {
            if (turns > 0) {
                EXPECT_NEAR(step.time_s - last_s, 0.24, 1e-6) << model;
            }
            last_s = step.time_s;
            turns += step.scan.turns;
            EXPECT_NEAR(turns, 10 * step.scan.time_s, 1e-3) << model;
        };
        const TrialResult result = runTrial(course, setup, constantProfile(80), nullptr, listener);
        EXPECT_EQ(result.outcome, Outcome::Success) << model;
        EXPECT_EQ(result.dropped_scans, 0) << model;
    }
}

TEST(Trial, ListenersDoNotChangeResult) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -4, 4);
    const Course course = simpleCourse(std::move(content));
    const LatencyProfile profile = constantProfile(10);
    TrialMeasurement measurement;
    TrialListener listener;
    int moves = 0, steps = 0;
    std::size_t candidates = 0;
    std::string last;
    listener.moved = [&](double, const VehicleState&) { ++moves; };
    listener.event = [&](const std::string& what) { last = what; };
    listener.step = [&](const TrialStep& step) {
        ++steps;
        candidates += step.plan.candidates.size();
        EXPECT_EQ(step.scan.points_m.size(), step.scan.labels.size());
    };
    listener.keeps_candidates = true;
    const TrialResult watched = runTrial(course, TrialSetup{}, profile, &measurement, listener);
    EXPECT_EQ(textOf(watched), textOf(runTrial(course, TrialSetup{}, profile)));
    EXPECT_NEAR(moves, watched.time_s / kControlStep_s + 1, 1);
    EXPECT_NEAR(steps, watched.scans, 1);
    EXPECT_GT(candidates, 0u);
    EXPECT_EQ(last, "success");
    for (const char* stage : {"filter", "W-RoI/update", "W-RoI/astar", "W-RoI/astar+primitives"}) {
        EXPECT_EQ(measurement.stage_ms[stage].size(), static_cast<std::size_t>(steps)) << stage;
    }
}

TEST(Trial, RejectsUnknownNames) {
    const Course course = simpleCourse(emptyContent());
    TrialSetup setup;
    setup.model = "W-Nothing";
    EXPECT_THROW(runTrial(course, setup, constantProfile(1)), std::invalid_argument);
    setup = {};
    setup.planner = "none";
    EXPECT_THROW(runTrial(course, setup, constantProfile(1)), std::invalid_argument);
    setup = {};
    EXPECT_THROW(runTrial(course, setup, LatencyProfile{}), std::runtime_error);
}

TEST(Trial, TrueScenePassesWires) {
    TrialSetup setup;
    setup.model = "oracle";
    setup.speed_m_s = 10;
    EXPECT_EQ(runTrial(makeCourse("wires", 8001), setup, constantProfile(10)).outcome,
              Outcome::Success);
}

TEST(Trial, TrueSceneIgnoresScans) {
    const Course course = makeCourse("movers", 1);
    TrialSetup setup;
    setup.model = "oracle+motion";
    TrialListener listener;
    std::size_t returns = 0;
    listener.step = [&](const TrialStep& step) { returns += step.scan.points_m.size(); };
    const TrialResult watched = runTrial(course, setup, constantProfile(10), nullptr, listener);
    EXPECT_GT(returns, 0u);
    EXPECT_EQ(textOf(runTrial(course, setup, constantProfile(10))), textOf(watched));
}

TEST(Calibration, MeasuresCostAlongFlight) {
    const std::vector<CostSample> samples = costAlongFlight("G-Full", 60);
    ASSERT_GE(samples.size(), 4u);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        EXPECT_GE(samples[i].path_m, samples[i - 1].path_m + 10);
        EXPECT_GT(samples[i].update_ms, 0);
    }
    EXPECT_GT(samples.back().bytes, samples.front().bytes);
}

TEST(Calibration, MeasuringMemoryIsInterruptible) {
    struct Interrupted {};
    int scans = 0;
    const auto stopAtTheThird = [&] {
        if (++scans == 3) throw Interrupted();
    };
    EXPECT_THROW(costAlongFlight("W-RoI", 1000, stopAtTheThird), Interrupted);
    EXPECT_EQ(scans, 3);
}

}  // namespace
}  // namespace hagen::avoidance
