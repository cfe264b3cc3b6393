#include <gtest/gtest.h>
#include <hagen/evaluation/Scores.h>

#include <cmath>
#include <stdexcept>

namespace hagen {
namespace {

constexpr auto U = Label::Unclassified, G = Label::Rou, O = Label::Roi;

Scan scanAt(const std::vector<float>& ranges_m) {
    Scan scan;
    scan.x_m = scan.range_m = ranges_m;
    return scan;
}

TEST(Scores, CountsByHand) {
    Scores scores;
    addScores(scanAt({1, 2, 3, 4, 5, 6, 7}), {2, 2, 2, 1, 1, 0, 2}, {O, O, G, O, G, O, U}, 20.0f,
              scores);
    EXPECT_EQ(scores.roi.hits, 2);
    EXPECT_EQ(scores.roi.misses, 2);  // one called ROU, one unclassified
    EXPECT_EQ(scores.roi.false_alarms, 1);
    EXPECT_EQ(scores.rou.hits, 1);
    EXPECT_EQ(scores.rou.misses, 1);
    EXPECT_EQ(scores.rou.false_alarms, 1);
    EXPECT_DOUBLE_EQ(scores.roi.precision(), 2.0 / 3);
    EXPECT_DOUBLE_EQ(scores.roi.recall(), 2.0 / 4);
    EXPECT_DOUBLE_EQ(scores.roi.f1(), 4.0 / 7);
}

TEST(Scores, SumsCountsOverScansBeforeTakingRatios) {
    Scores scores;
    addScores(scanAt({1}), {2}, {O}, 20.0f, scores);
    addScores(scanAt({1, 1, 1}), {2, 2, 2}, {G, G, G}, 20.0f, scores);
    EXPECT_DOUBLE_EQ(scores.roi.recall(), 0.25);
}

TEST(Scores, LeavesOutReturnsBeyondTheRangeAndWithoutOne) {
    Scores scores;
    addScores(scanAt({20, 20.5f, NAN}), {2, 2, 2}, {O, O, O}, 20.0f, scores);
    EXPECT_EQ(scores.roi.hits, 1);
    EXPECT_EQ(scores.roi.misses, 0);
}

TEST(Scores, NothingToScoreIsNotANumber) {
    EXPECT_TRUE(std::isnan(Scores().roi.f1()));
    EXPECT_TRUE(std::isnan(Scores().rou.precision()));
}

TEST(Scores, RefusesLabelsOfOtherScansAndOtherMeanings) {
    Scores scores;
    EXPECT_THROW(addScores(scanAt({1, 2}), {2}, {O, O}, 20.0f, scores), std::invalid_argument);
    EXPECT_THROW(addScores(scanAt({1, 2}), {2, 2}, {O}, 20.0f, scores), std::invalid_argument);
    EXPECT_THROW(addScores(scanAt({1}), {40}, {O}, 20.0f, scores), std::invalid_argument);
}

}  // namespace
}  // namespace hagen
