#include "evaluation/Bootstrap.h"
#include <gtest/gtest.h>

#include <stdexcept>

namespace hagen::evaluation {
namespace {

/// Scans with one RoI return each; every second return is found.
std::vector<Scores> everySecondFound(int scans) {
    std::vector<Scores> all;
    for (int i = 0; i < scans; ++i) {
        Scores scores;
        addScore(Label::Roi, i % 2 == 0 ? Label::Roi : Label::Rou, scores);
        all.push_back(scores);
    }
    return all;
}

TEST(Bootstrap, MatchesBinomialInterval) {
    // Recall 0.5 for n = 400 scans: the standard deviation is sqrt(0.25 / 400) = 0.025, and 95 %
    // lie within 1.96 deviations. Counts are integers, so bounds are multiples of 1 / 400.
    BootstrapOptions options;
    options.resamples = 4000;
    const Interval recall = bootstrapIntervals(everySecondFound(400), options).roi.recall;
    EXPECT_NEAR(recall.low, 0.5 - 1.96 * 0.025, 0.0035);
    EXPECT_NEAR(recall.high, 0.5 + 1.96 * 0.025, 0.0035);
    options.level = 0.6827;
    const Interval narrow = bootstrapIntervals(everySecondFound(400), options).roi.recall;
    EXPECT_NEAR(narrow.high - narrow.low, 2 * 0.025, 0.0055);
}

TEST(Bootstrap, ResamplesScansInsteadOfReturns) {
    // If one scan is found and the other missed, recall is 0, 0.5 or 1 for any number of returns.
    std::vector<Scores> scans(2);
    scans[0].roi.hits = 1000;
    scans[1].roi.misses = 1000;
    const Interval recall = bootstrapIntervals(scans).roi.recall;
    EXPECT_EQ(recall.low, 0.0);
    EXPECT_EQ(recall.high, 1.0);
}

TEST(Bootstrap, DependsOnSeedOnly) {
    BootstrapOptions options;
    options.resamples = 100;
    const auto first = bootstrapIntervals(everySecondFound(1001), options);
    const auto again = bootstrapIntervals(everySecondFound(1001), options);
    options.seed = 2;
    const auto other = bootstrapIntervals(everySecondFound(1001), options);
    EXPECT_EQ(first.roi.f1.low, again.roi.f1.low);
    EXPECT_EQ(first.roi.f1.high, again.roi.f1.high);
    EXPECT_NE(first.roi.f1.low, other.roi.f1.low);
}

TEST(Bootstrap, StopsWhenCallbackThrows) {
    BootstrapOptions options;
    options.resamples = 1000000;
    int asked = 0;
    options.continuing = [&] {
        if (++asked == 10) throw std::runtime_error("interrupted");
    };
    EXPECT_THROW(bootstrapIntervals(everySecondFound(4), options), std::runtime_error);
    EXPECT_EQ(asked, 10);
}

TEST(Bootstrap, HasNoIntervalWithoutData) {
    EXPECT_TRUE(std::isnan(bootstrapIntervals({}).roi.f1.low));
    EXPECT_TRUE(std::isnan(bootstrapIntervals(everySecondFound(1)).roi.f1.low));
    EXPECT_TRUE(std::isnan(bootstrapIntervals(everySecondFound(4)).rou.recall.low));  // no ROU
    BootstrapOptions none;
    none.resamples = 0;
    EXPECT_TRUE(std::isnan(bootstrapIntervals(everySecondFound(4), none).roi.f1.low));
}

}  // namespace
}  // namespace hagen::evaluation
