#include <gtest/gtest.h>
#include <hagen/evaluation/Baselines.h>

#include <set>

#include "support/BaselineRules.h"

namespace hagen::evaluation {
namespace {

TEST(Baselines, FollowCommonRules) {
    for (const float zone_m : {8.0f, 20.0f}) {
        for (const Baseline& baseline : baselines(zone_m)) {
            test::expectBaselineRules(baseline, zone_m);
        }
    }
}

TEST(Baselines, HaveUniqueNames) {
    std::set<std::string> names, parameters;
    for (const Baseline& baseline : baselines(20.0f)) {
        EXPECT_TRUE(names.insert(baseline.name).second) << baseline.name;
        EXPECT_TRUE(parameters.insert(baseline.parameters).second) << baseline.name;
    }
    EXPECT_EQ(names.count("zermas"), 1u);
    EXPECT_EQ(names.count("bogoslavskyi"), 1u);
}

TEST(Baselines, LimitChangesParameters) {
    for (const Baseline& baseline : baselines(20.0f)) {
        const std::string parameters = baseline.withLimit(3.25f).parameters;
        EXPECT_NE(parameters.find("3.25"), std::string::npos) << parameters;
    }
}

}  // namespace
}  // namespace hagen::evaluation
