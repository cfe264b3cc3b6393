#include "evaluation/Breakdown.h"
#include <gtest/gtest.h>

namespace hagen::evaluation {
namespace {

Scores roi(std::int64_t hits, std::int64_t misses) {
    Scores scores;
    scores.roi.hits = hits;
    scores.roi.misses = misses;
    return scores;
}

ScanScores scanAt(double altitude_m, std::size_t folder, const Scores& scores) {
    ScanScores scan;
    scan.altitude_m = altitude_m;
    scan.folder = folder;
    scan.all = scores;
    return scan;
}

TEST(Breakdown, AltitudeBandsIncludeLowerBound) {
    const std::vector<Group> groups =
        byAltitude({scanAt(1.99, 0, roi(1, 0)), scanAt(2, 0, roi(2, 0)), scanAt(2.5, 0, roi(3, 0)),
                    scanAt(10, 0, roi(4, 0)), scanAt(NAN, 0, roi(5, 0))});
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].name, "0-2 m");
    EXPECT_EQ(groups[0].sum().roi.hits, 1);
    EXPECT_EQ(groups[1].name, "2-3 m");
    EXPECT_EQ(groups[1].scans.size(), 2u);
    EXPECT_EQ(groups[1].sum().roi.hits, 5);
    EXPECT_EQ(groups[2].name, "10+ m");
    EXPECT_EQ(groups[2].sum().roi.hits, 4);
}

TEST(Breakdown, NegativeAltitudesHaveOwnBand) {
    const std::vector<Group> groups = byAltitude(
        {scanAt(-0.01, 0, roi(1, 0)), scanAt(-30, 0, roi(2, 0)), scanAt(0, 0, roi(3, 0))});
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].name, "below 0 m");
    EXPECT_EQ(groups[0].sum().roi.hits, 3);
    EXPECT_EQ(groups[1].name, "0-2 m");
    EXPECT_EQ(groups[1].sum().roi.hits, 3);
}

TEST(Breakdown, FoldersKeepOrderAndSum) {
    const std::vector<ScanScores> scans{scanAt(1, 1, roi(1, 2)), scanAt(1, 0, roi(3, 0)),
                                        scanAt(1, 1, roi(0, 4))};
    const std::vector<Group> groups = byFolder(scans, {"b", "a"});
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].name, "b");
    EXPECT_EQ(groups[0].sum().roi.hits, 3);
    EXPECT_EQ(groups[1].sum().roi.misses, 6);
    EXPECT_EQ(overallScores(scans).sum().roi.hits, 4);
    EXPECT_EQ(overallScores(scans).sum().roi.misses, 6);
}

TEST(Breakdown, RangeBandsSkipEmptyScans) {
    ScanScores near = scanAt(1, 0, roi(1, 0)), far = near;
    near.by_range = {roi(1, 0), {}, {}};
    far.by_range = {roi(2, 0), {}, roi(0, 3)};
    const std::vector<Group> groups = byRange({near, far}, {15, 5});
    ASSERT_EQ(groups.size(), 2u);  // no returns at 5-10 m
    EXPECT_EQ(groups[0].scans.size(), 2u);
    EXPECT_EQ(groups[1].name, "10-15 m");
    EXPECT_EQ(groups[1].scans.size(), 1u);
    EXPECT_EQ(groups[1].sum().roi.misses, 3);
}

TEST(Breakdown, ClassesAreMergedOverScans) {
    ScanScores first, second;
    first.by_kind = {{"wire", roi(1, 1)}};
    second.by_kind = {{"tree", roi(5, 0)}, {"wire", roi(0, 2)}};
    const std::vector<Group> groups = byKind({first, second});
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].name, "tree");
    EXPECT_EQ(groups[1].name, "wire");
    EXPECT_DOUBLE_EQ(groups[1].sum().correct(), 0.25);
}

}  // namespace
}  // namespace hagen::evaluation
