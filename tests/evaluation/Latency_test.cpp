#include "evaluation/Latency.h"
#include <gtest/gtest.h>

#include <numeric>

namespace hagen::evaluation {
namespace {

TEST(Latency, MatchesHandComputation) {
    // 1 + 2 + 3 + 6 = 12; the squares of -2, -1, 0, 3 sum to 14, divided by 3.
    const Latency latency = latencyOf({6, 1, 3, 2});
    EXPECT_EQ(latency.runs, 4u);
    EXPECT_DOUBLE_EQ(latency.mean_ms, 3);
    EXPECT_DOUBLE_EQ(latency.sd_ms, std::sqrt(14.0 / 3));
    EXPECT_EQ(latency.p50_ms, 2);
    EXPECT_EQ(latency.p95_ms, 6);
    EXPECT_EQ(latency.max_ms, 6);
}

TEST(Latency, UsesNearestRankPercentiles) {
    std::vector<double> runs_ms(200);
    std::iota(runs_ms.begin(), runs_ms.end(), 1);
    const Latency latency = latencyOf(runs_ms);
    EXPECT_EQ(latency.p50_ms, 100);
    EXPECT_EQ(latency.p95_ms, 190);
    EXPECT_EQ(latency.p99_ms, 198);
}

TEST(Latency, HandlesZeroAndOneRun) {
    EXPECT_EQ(latencyOf({}).runs, 0u);
    EXPECT_TRUE(std::isnan(latencyOf({}).mean_ms));
    EXPECT_EQ(latencyOf({5}).p99_ms, 5);
    EXPECT_TRUE(std::isnan(latencyOf({5}).sd_ms));
}

}  // namespace
}  // namespace hagen::evaluation
