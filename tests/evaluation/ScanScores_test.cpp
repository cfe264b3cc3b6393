#include <gmock/gmock.h>
#include <hagen/evaluation/ScanScores.h>

#include <stdexcept>

#include "evaluation/Labels.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

const LabelMap kKinds{{5, {"wire", O}}, {3, {"tree", O}}, {1, {"terrain", G}}};

GroundTruthScan scanAt(const std::vector<float>& ranges_m, const std::vector<Label>& truth) {
    GroundTruthScan scan;
    scan.input.scan.x_m = scan.input.scan.range_m = ranges_m;
    scan.truth = truth;
    return scan;
}

TEST(ScanScores, IgnoreFarAndMissingRanges) {
    const ScanScores scores = scoreScan(scanAt({20, 20.5f, NAN}, {O, O, O}), {O, O, O}, {}, {});
    EXPECT_EQ(scores.all.roi.hits, 1);
    EXPECT_EQ(scores.all.roi.misses, 0);
}

TEST(ScanScores, RangeBandsIncludeLowerBound) {
    // Bands of 5 m up to 12 m: 4.9 | 5 9.9 | 10 12, i.e. 1, 2 and 2 returns.
    const RangeBands bands{12, 5};
    const ScanScores scores =
        scoreScan(scanAt({4.9f, 5, 9.9f, 10, 12}, {O, O, O, G, G}), {O, O, G, G, O}, {}, bands);
    ASSERT_EQ(scores.by_range.size(), 3u);
    EXPECT_EQ(scores.by_range[0].roi.hits, 1);
    EXPECT_EQ(scores.by_range[1].roi.hits, 1);
    EXPECT_EQ(scores.by_range[1].roi.misses, 1);
    EXPECT_EQ(scores.by_range[2].rou.hits, 1);
    EXPECT_EQ(scores.by_range[2].rou.misses, 1);
    EXPECT_EQ(bands.nameOf(1), "5-10 m");
    EXPECT_EQ(bands.nameOf(2), "10-12 m");
    EXPECT_EQ((RangeBands{20, 5}.bandOf(20)), 3u);
}

TEST(ScanScores, RejectExcessiveBandCounts) {
    for (const RangeBands bands :
         {RangeBands{INFINITY, 5}, RangeBands{NAN, 5}, RangeBands{1e30f, 5}, RangeBands{20, 0}}) {
        EXPECT_THROW(bands.count(), std::invalid_argument);
        EXPECT_THROW(scoreScan(scanAt({1}, {O}), {O}, {}, bands), std::invalid_argument);
    }
    EXPECT_EQ((RangeBands{1000, 5}.count()), 200u);
    EXPECT_EQ((RangeBands{-1, 5}.count()), 1u);
}

TEST(ScanScores, ScoreClassesByName) {
    // Two wires, one missed; a found tree; terrain labelled RoI; dust, whose class is excluded.
    GroundTruthScan scan = scanAt({1, 2, 3, 4, 5}, {O, O, O, G, U});
    scan.kinds = {5, 5, 3, 1, 10};
    const ScanScores scores = scoreScan(scan, {O, G, O, O, O}, kKinds, {});
    ASSERT_EQ(scores.by_kind.size(), 3u);
    EXPECT_DOUBLE_EQ(scores.by_kind.at("wire").correct(), 0.5);
    EXPECT_DOUBLE_EQ(scores.by_kind.at("tree").correct(), 1);
    EXPECT_DOUBLE_EQ(scores.by_kind.at("terrain").correct(), 0);
}

TEST(ScanScores, ScoreChosenReturnsOnly) {
    const std::vector<std::size_t> chosen{2};
    const ScanScores scores = scoreScan(scanAt({1, 2, 3}, {O, O, O}), {G, G, O}, {}, {}, &chosen);
    EXPECT_EQ(scores.all.returns(), 1);
    EXPECT_EQ(scores.all.roi.hits, 1);
}

TEST(ScanScores, AcceptEmptyScans) {
    EXPECT_EQ(scoreScan(scanAt({}, {}), {}, {}, {}).all.returns(), 0);
}

TEST(ScanScores, RejectWrongSizesAndClasses) {
    EXPECT_THROW(scoreScan(scanAt({1, 2}, {O}), {O, O}, {}, {}), std::invalid_argument);
    EXPECT_THROW(scoreScan(scanAt({1, 2}, {O, O}), {O}, {}, {}), std::invalid_argument);
    GroundTruthScan scan = scanAt({1}, {O});
    scan.kinds = {5, 5};
    EXPECT_THROW(scoreScan(scan, {O}, kKinds, {}), std::invalid_argument);
    scan.kinds = {77};
    EXPECT_THAT([&] { scoreScan(scan, {O}, kKinds, {}); },
                testing::ThrowsMessage<std::invalid_argument>(HasSubstr("class 77")));
}

}  // namespace
}  // namespace hagen::evaluation
