#include <gtest/gtest.h>
#include <hagen/live/LatencyHistogram.h>
#include "base/Quantile.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hagen::live {
namespace {

TEST(LatencyHistogram, QuantilesWithinTwoPercent) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> times_ms(0, 1.5);
    LatencyHistogram histogram;
    std::vector<double> all_s;
    for (int i = 0; i < 20000; ++i) {
        all_s.push_back(1e-3 * times_ms(random));
        histogram.add(all_s.back());
    }
    std::sort(all_s.begin(), all_s.end());
    for (const double share : {0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
        const double exact_s = base::nearestRankOfSorted(all_s, share);
        EXPECT_GE(histogram.quantile_s(share), exact_s * (1 - 1e-9)) << share;
        EXPECT_LE(histogram.quantile_s(share), exact_s * 1.0201) << share;
    }
    EXPECT_EQ(histogram.max_s(), all_s.back());
    EXPECT_EQ(histogram.count(), all_s.size());
}

TEST(LatencyHistogram, AcceptsAnyTime) {
    LatencyHistogram histogram;
    EXPECT_TRUE(std::isnan(histogram.quantile_s(0.5)));
    EXPECT_EQ(histogram.max_s(), 0);
    for (const double time_s : {-1.0, 0.0, 1e9, std::nan("")}) histogram.add(time_s);
    EXPECT_EQ(histogram.count(), 4u);
    EXPECT_LE(histogram.quantile_s(0.5), 1e-6);
    EXPECT_GT(histogram.quantile_s(1), 90);
}

}  // namespace
}  // namespace hagen::live
