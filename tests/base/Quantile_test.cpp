#include "base/Quantile.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

namespace hagen::base {
namespace {

TEST(Quantile, InterpolatesBetweenRanks) {
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
    EXPECT_DOUBLE_EQ(quantile({10, 20}, 0.25), 12.5);
    EXPECT_DOUBLE_EQ(quantile({7}, 0.3), 7);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Quantile, NearestRankIsSmallestCoveringValue) {
    std::mt19937 random(3);
    for (std::size_t count = 1; count < 60; ++count) {
        std::vector<double> values(count);
        for (double& value : values) value = static_cast<double>(random() % 20);
        std::sort(values.begin(), values.end());
        for (const double share : {0.01, 0.5, 0.95, 1.0}) {
            const double found = nearestRankOfSorted(values, share);
            const auto upTo = [&](double limit) {
                return static_cast<double>(std::count_if(
                    values.begin(), values.end(), [&](double value) { return value <= limit; }));
            };
            EXPECT_GE(upTo(found), share * static_cast<double>(count));
            for (const double value : values) {
                if (value < found) {
                    EXPECT_LT(upTo(value), share * static_cast<double>(count));
                }
            }
        }
    }
}

}  // namespace
}  // namespace hagen::base
