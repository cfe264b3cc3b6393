#include <gtest/gtest.h>
#include <hagen/evaluation/Scores.h>

#include <cmath>
#include <vector>

#include "evaluation/Labels.h"

namespace hagen::evaluation {
namespace {

Scores scoresOf(const std::vector<Label>& truth, const std::vector<Label>& found) {
    Scores scores;
    for (std::size_t i = 0; i < truth.size(); ++i) addScore(truth[i], found[i], scores);
    return scores;
}

TEST(Scores, MatchHandCounts) {
    // Of four RoI returns, two are found, one is labelled ROU and one unclassified; of two ROU
    // returns, one is found and one is labelled RoI; the return without a true label is ignored.
    const Scores scores = scoresOf({O, O, O, G, G, U, O}, {O, O, G, O, G, O, U});
    EXPECT_EQ(scores.roi.hits, 2);
    EXPECT_EQ(scores.roi.misses, 2);
    EXPECT_EQ(scores.roi.false_alarms, 1);
    EXPECT_EQ(scores.rou.hits, 1);
    EXPECT_EQ(scores.rou.misses, 1);
    EXPECT_EQ(scores.rou.false_alarms, 1);
    EXPECT_DOUBLE_EQ(scores.roi.precision(), 2.0 / 3);
    EXPECT_DOUBLE_EQ(scores.roi.recall(), 2.0 / 4);
    EXPECT_DOUBLE_EQ(scores.roi.f1(), 4.0 / 7);
    EXPECT_EQ(scores.returns(), 6);
    EXPECT_DOUBLE_EQ(scores.correct(), 3.0 / 6);
}

TEST(Scores, SumCountsBeforeRatios) {
    Scores sum = scoresOf({O}, {O});
    sum += scoresOf({O, O, O, G}, {G, G, G, O});
    EXPECT_DOUBLE_EQ(sum.roi.recall(), 0.25);  // the mean of the two recalls would be 0.5
    EXPECT_EQ(sum.rou.misses, 1);
    EXPECT_EQ(sum.rou.false_alarms, 3);
}

TEST(Scores, AreNanWithoutData) {
    EXPECT_TRUE(std::isnan(Scores().roi.f1()));
    EXPECT_TRUE(std::isnan(Scores().rou.precision()));
    EXPECT_TRUE(std::isnan(Scores().correct()));
}

}  // namespace
}  // namespace hagen::evaluation
