#include "avoidance/flights/CampaignPlan.h"
#include <gmock/gmock.h>
#include <hagen/avoidance/WorldModel.h>
#include "avoidance/flights/Calibration.h"
#include "avoidance/flights/RunTable.h"

#include <set>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

using test::messageOf;
using testing::HasSubstr;

TEST(CampaignPlan, FliesEveryCombinationOnce) {
    CampaignPlan plan;
    plan.scenarios = {"gap", "street"};
    plan.first_seed = 5;
    plan.last_seed = 7;
    plan.models = {"W-RoI", "oracle"};
    plan.guidances = {"straight", "astar"};
    plan.planners = {"primitives", "3dvfh"};
    plan.speeds_m_s = {4, 8};
    plan.pose_errors = {PoseError::None, PoseError::Drift};
    plan.latency_scales = {1, 2};
    plan.airs = {Air::Dusty, Air::Clear};
    plan.distances = {ModelDistance::Unbiased, ModelDistance::AsStored};
    plan.updates = {Updates::Scans, Updates::Sectors};
    plan.brakes_in_known_space = true;
    const auto flights = flightsOf(plan);
    ASSERT_EQ(flights.size(), 6u);
    EXPECT_EQ(flights[1].seed, 5u);
    EXPECT_EQ(flights[1].scenario, "street");
    std::set<std::string> keys;
    for (const TrialSetup& setup : flights[0].setups) {
        EXPECT_TRUE(setup.brakes_in_known_space);
        hagen::avoidance::Run run{};
        run.setup = setup;
        keys.insert(keyOf(run));
    }
    EXPECT_EQ(keys.size(), 512u);
}

TEST(CampaignPlan, ShardsPartitionFlights) {
    CampaignPlan plan;
    plan.scenarios = {"gap", "street", "wires"};
    plan.last_seed = 6;
    std::vector<std::string> all, shards;
    const auto note = [](const std::vector<CourseFlights>& flights, std::vector<std::string>& to) {
        for (const auto& course : flights)
            to.push_back(course.scenario + std::to_string(course.seed));
    };
    note(flightsOf(plan), all);
    for (int number = 1; number <= 4; ++number) note(flightsOf(plan, {number, 4}), shards);
    std::sort(all.begin(), all.end());
    std::sort(shards.begin(), shards.end());
    EXPECT_EQ(all, shards);
}

TEST(CampaignPlan, RejectsInvalidPlans) {
    CampaignPlan good;
    good.scenarios = {"gap"};
    const auto fails = [&](const std::function<void(CampaignPlan&)>& change, Shard shard = {}) {
        CampaignPlan plan = good;
        change(plan);
        return test::messageOf<std::invalid_argument>([&] { flightsOf(plan, shard); });
    };
    EXPECT_EQ(fails([](CampaignPlan&) {}), "");
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.scenarios = {"moon"}; }), HasSubstr("'moon'"));
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.models = {"X"}; }), HasSubstr("W-RoI"));
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.first_seed = 3; }), HasSubstr("seed"));
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.speeds_m_s = {0}; }), HasSubstr("speed"));
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.updates.clear(); }), HasSubstr("update"));
    EXPECT_THAT(fails([](CampaignPlan& plan) { plan.last_seed = 1'000'000; }),
                HasSubstr("more than 1000000 flights"));
    EXPECT_THAT(fails([](CampaignPlan& plan) {
                    plan.speeds_m_s.assign(100'000, 4);
                    plan.latency_scales.assign(100'000, 1);
                }),
                HasSubstr("more than 1000000 flights"));
    EXPECT_THAT(fails([](CampaignPlan&) {}, {5, 4}), HasSubstr("shard"));
    EXPECT_THAT(fails([](CampaignPlan&) {}, {0, 4}), HasSubstr("shard"));
}

TEST(CampaignPlan, TrackingModelsRequireWholeScans) {
    CampaignPlan plan;
    plan.scenarios = {"gap"};
    for (const std::string& model : worldModelNames()) {
        plan.models = {model};
        const bool follows = model.find("+motion") != std::string::npos && model[0] != 'o';
        plan.updates = {Updates::Scans};
        EXPECT_EQ(flightsOf(plan)[0].setups.size(), 1u) << model;
        plan.updates = {Updates::Scans, Updates::Sectors};
        try {
            EXPECT_EQ(flightsOf(plan)[0].setups.size(), 2u) << model;
            EXPECT_FALSE(follows) << model;
        } catch (const std::invalid_argument& e) {
            EXPECT_TRUE(follows) << model;
            EXPECT_THAT(e.what(), HasSubstr(model));
        }
    }
}

TEST(CampaignPlan, ReportsMissingStage) {
    CampaignPlan plan;
    plan.scenarios = {"gap"};
    LatencyProfile profile = constantProfile(1);
    checkProfile(profile, flightsOf(plan));
    profile.quantiles_ms.erase("W-RoI/astar");
    EXPECT_THAT(messageOf([&] { checkProfile(profile, flightsOf(plan)); }),
                HasSubstr("W-RoI/astar"));
}

}  // namespace
}  // namespace hagen::avoidance
