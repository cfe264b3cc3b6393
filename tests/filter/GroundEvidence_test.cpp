#include "filter/simd/GroundEvidence.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/GroundPixels.h"

namespace hagen {
namespace {

using test::kEmptyPixel;
using test::pixelsAt;

constexpr float kWithdrawn = -std::numeric_limits<float>::infinity();

GroundEvidenceWorkspace evidence_work;  // reused, as in a filter

/// Flags of the level pixels in columns of `rows` pixels, lowest row first.
std::vector<int> level(const std::vector<Eigen::Vector3f>& points_m, int rows) {
    const PixelPoints pixels = pixelsAt(points_m, rows);
    Image<std::uint8_t> is_level;
    PixelCells cells;
    findPixelCells(pixels, cells);
    findLevelPixels(pixels, cells, is_level, evidence_work);
    EXPECT_EQ(is_level.rows(), pixels.x_m.rows());
    EXPECT_EQ(is_level.cols(), pixels.x_m.cols());
    return {is_level.data(), is_level.data() + is_level.size()};
}
std::vector<int> levelInColumn(const std::vector<Eigen::Vector3f>& column_m) {
    return level(column_m, static_cast<int>(column_m.size()));
}

TEST(FindLevelPixels, StepSlopeIsBelowThreeTenths) {
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {6, 0, 0.299f}}), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {6, 0, 0.301f}}), (std::vector{0, 0}));
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {6, 0, -0.299f}}), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {6, 0, -0.301f}}), (std::vector{0, 0}));
    // The steps are 13 m long (5 m in x, 12 m in y) and may rise by 0.3 * 13 m = 3.9 m.
    EXPECT_EQ(levelInColumn({{5, -12, 0}, {10, -24, 3.89f}}), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn({{5, -12, 0}, {10, -24, 3.91f}}), (std::vector{0, 0}));
}

TEST(FindLevelPixels, OnlyOutwardStepsAreLevel) {
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {6, 0, 0}}), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn({{6, 0, 0}, {5, 0, 0}}), (std::vector{0, 0}));
    EXPECT_EQ(levelInColumn({{-5, 0, 0}, {-6, 0, 0}}), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn({{0, -6, 0}, {0, -5, 0}}), (std::vector{0, 0}));
    EXPECT_EQ(levelInColumn({{5, 0, 0}, {5, 0, 0}}), (std::vector{0, 0}));  // a step of length 0
}

TEST(FindLevelPixels, ShortStepsAreSkipped) {
    // Ranges have 2 cm errors: the short steps are steep, the long one is not.
    EXPECT_EQ(levelInColumn({{1, 0, 0}, {1.05f, 0, 0.02f}, {1.1f, 0, 0}}), (std::vector{1, 0, 1}));
    EXPECT_EQ(levelInColumn({{1, 0, 0}, {1.05f, 0, 0.09f}, {1.1f, 0, 0}}), (std::vector{0, 0, 0}));
    EXPECT_EQ(levelInColumn({{1, 0, 0}, {1, 0, 0.05f}, {1, 0, 0.1f}}), (std::vector{0, 0, 0}));
    EXPECT_EQ(levelInColumn({{1.2f, 0, 0}, {1.15f, 0, 0.02f}, {1.1f, 0, 0}}),
              (std::vector{0, 0, 0}));
    // Steps never lead to the next column.
    EXPECT_EQ(level({{1, 0, 0}, {1.05f, 0, 0.02f}, {1.1f, 0, 0}, {9, 0, 9}}, 2),
              (std::vector{0, 0, 0, 0}));
}

TEST(FindLevelPixels, EmptyPixelsAreSkipped) {
    const Eigen::Vector3f low(3, 0, 0), high(4, 0, 0.2f), steep(4, 0, 0.4f), none = kEmptyPixel;
    EXPECT_EQ(levelInColumn({low, none, high}), (std::vector{1, 0, 1}));
    EXPECT_EQ(levelInColumn({low, none, none, none, high}), (std::vector{1, 0, 0, 0, 1}));
    EXPECT_EQ(levelInColumn({low, none, none, none, none, high}),
              (std::vector{0, 0, 0, 0, 0, 0}));  // too many empty pixels
    EXPECT_EQ(levelInColumn({low, none, steep}), (std::vector{0, 0, 0}));
    // A distant return in between is not skipped.
    EXPECT_EQ(levelInColumn({low, {3, 0, 0.3f}, {3.1f, 0, 0.4f}, {4, 0, 0}}),
              (std::vector{0, 0, 0, 0}));
    // Steps across empty pixels are limited to 2 m; steps to the adjacent pixel are not.
    EXPECT_EQ(levelInColumn({low, none, {4.99f, 0, 0}}), (std::vector{1, 0, 1}));
    EXPECT_EQ(levelInColumn({low, none, {5.01f, 0, 0}}), (std::vector{0, 0, 0}));
    EXPECT_EQ(levelInColumn({low, {9, 0, 0}}), (std::vector{1, 1}));
    EXPECT_EQ(level({none, low, none, high}, 2), (std::vector{0, 0, 0, 0}));
}

// The table top at 0.75 m is in the cell from 3 to 3.75 m.
TEST(FindLevelPixels, TableOverFloorIsNotLevel) {
    const std::vector<Eigen::Vector3f> floor{{3.1f, 0.1f, 0}, {4.6f, 0.1f, 0}};
    const std::vector<Eigen::Vector3f> table{{3.2f, 0.3f, 0.75f}, {3.6f, 0.3f, 0.75f}};
    EXPECT_EQ(levelInColumn(floor), (std::vector{1, 1}));
    EXPECT_EQ(levelInColumn(table), (std::vector{1, 1}));
    EXPECT_EQ(level({floor[0], floor[1], table[0], table[1]}, 2), (std::vector{1, 1, 0, 0}));
    EXPECT_EQ(level({table[0], table[1], floor[0], floor[1]}, 2), (std::vector{0, 0, 1, 1}));
    // Floor in another cell is irrelevant.
    EXPECT_EQ(level({table[0], table[1], {3.8f, 0.1f, 0}, {4.6f, 0.1f, 0}}, 2),
              (std::vector{1, 1, 1, 1}));
}

TEST(FindLevelPixels, ToleratesSmallDropsBelow) {
    const auto over = [](float below_m) {
        return level({{3.2f, 0.3f, 1}, {3.6f, 0.3f, 1}, {3.4f, 0.1f, 1 - below_m}, kEmptyPixel}, 2);
    };
    EXPECT_EQ(over(0.29f), (std::vector{1, 1, 0, 0}));
    EXPECT_EQ(over(0.31f), (std::vector{0, 0, 0, 0}));
}

TEST(KeepLevelRou, KeepsOnlyLevelRou) {
    Image<Label> labels(2, 3), expected(2, 3), candidates;
    labels << Label::Rou, Label::Roi, Label::Unclassified, Label::Rou, Label::Roi,
        Label::Unclassified;
    Image<std::uint8_t> is_level(2, 3);
    is_level << 1, 1, 1, 0, 0, 0;
    keepLevelRou(labels, is_level, candidates);
    expected.setConstant(Label::Unclassified);
    expected(0, 0) = Label::Rou;
    EXPECT_EQ(candidates.rows(), 2);
    EXPECT_TRUE((candidates == expected).all());
}

/// A pixel as used by requireEvidence().
struct Seen {
    float x_m, y_m, height_m;
    bool is_level;
};

/// The tolerances after requireEvidence(); initially 0.5 m.
std::vector<float> required(const std::vector<Seen>& seen, int rows = 1,
                            float sensor_height_m = 2) {
    std::vector<Eigen::Vector3f> points_m;
    for (const Seen& s : seen) points_m.emplace_back(s.x_m, s.y_m, s.height_m);
    const PixelPoints pixels = pixelsAt(points_m, rows);
    Image<std::uint8_t> is_level(rows, pixels.x_m.cols());
    Image<float> tolerance_m(rows, pixels.x_m.cols());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        is_level.data()[i] = seen[i].is_level;
        tolerance_m.data()[i] = hasValue(seen[i].height_m) ? 0.5f : kNoValue;
    }
    PixelCells cells;
    findPixelCells(pixels, cells);
    std::vector<std::uint8_t> has_evidence(7, 1);  // from an earlier scan
    requireEvidence(pixels, cells, pixels.z_m, is_level, sensor_height_m, tolerance_m,
                    has_evidence);
    EXPECT_EQ(has_evidence.size(), PixelCells::kNoBlock + 1u);
    EXPECT_EQ(has_evidence.back(), 0);
    for (Eigen::Index i = 0; i < tolerance_m.size(); ++i) {
        const float m = tolerance_m.data()[i];
        if (!hasValue(m)) continue;
        EXPECT_EQ(has_evidence[cells.block.data()[i]], m == 0.5f ? 1 : 0) << i;
    }
    return {tolerance_m.data(), tolerance_m.data() + tolerance_m.size()};
}

/// `number` pixels in one cell, close to the surface; the first `of_them_level` are level.
std::vector<Seen> closePixels(int number, int of_them_level, float x_m = 1, float y_m = 1) {
    std::vector<Seen> pixels(static_cast<std::size_t>(number), {x_m, y_m, 0, false});
    for (int i = 0; i < of_them_level; ++i) pixels[static_cast<std::size_t>(i)].is_level = true;
    return pixels;
}

bool allAre(float value, const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [&](float v) { return v == value; });
}

TEST(RequireEvidence, NeedsFiftyFivePercentLevel) {
    EXPECT_TRUE(allAre(kWithdrawn, required(closePixels(1000, 549))));
    EXPECT_TRUE(allAre(0.5f, required(closePixels(1000, 551))));
    EXPECT_TRUE(allAre(kWithdrawn, required(closePixels(1000, 0))));
    EXPECT_TRUE(allAre(0.5f, required(closePixels(1000, 1000))));
    EXPECT_TRUE(allAre(0.5f, required(closePixels(1, 1))));
}

TEST(RequireEvidence, SumsSharesOverCells) {
    // On its own, the cell at 1 m has evidence, but the cell at 5 m does not.
    std::vector<Seen> pixels = closePixels(100, 80);
    const auto join = [&](const std::vector<Seen>& more) {
        pixels.insert(pixels.end(), more.begin(), more.end());
    };
    join(closePixels(100, 31, 5, -4));
    EXPECT_TRUE(allAre(0.5f, required(pixels)));
    join(closePixels(3, 0, -6, 7));
    EXPECT_TRUE(allAre(kWithdrawn, required(pixels)));
}

// Blocks are 3 m wide: x = 1 is in the block from 0 to 3 m, x = 12 is four blocks farther.
TEST(RequireEvidence, ReachesFourBlocks) {
    const auto toleratedAt = [](float x_m, float y_m) {
        return required({{1, 1, 0, true}, {x_m, y_m, 5, false}}).back();
    };
    for (const float aside_m : {-11.9f, 1.0f, 14.9f}) {
        EXPECT_EQ(toleratedAt(14.9f, aside_m), 0.5f);
        EXPECT_EQ(toleratedAt(15.1f, aside_m), kWithdrawn);
        EXPECT_EQ(toleratedAt(-11.9f, aside_m), 0.5f);
        EXPECT_EQ(toleratedAt(-12.1f, aside_m), kWithdrawn);
        EXPECT_EQ(toleratedAt(aside_m, 14.9f), 0.5f);
        EXPECT_EQ(toleratedAt(aside_m, 15.1f), kWithdrawn);
        EXPECT_EQ(toleratedAt(aside_m, -11.9f), 0.5f);
        EXPECT_EQ(toleratedAt(aside_m, -12.1f), kWithdrawn);
    }
}

TEST(RequireEvidence, EndsAtGrazingAngles) {
    const auto isSeen = [](float x_m, float sensor_height_m) {
        return required({{x_m, 1, 0, true}}, 1, sensor_height_m).front() == 0.5f;
    };
    // The block from 9 to 12 m is 10.61 m away, because its centre is also 1.5 m aside.
    EXPECT_TRUE(isSeen(10, 10.62f / 40));
    EXPECT_FALSE(isSeen(10, 10.59f / 40));
    EXPECT_TRUE(isSeen(1, 0.11f));
    EXPECT_FALSE(isSeen(1, 0.09f));  // the sensor is on a table
}

TEST(RequireEvidence, EndsAtGridEdge) {
    // Grid columns are contiguous in memory, but a column's end is not near the next one's start.
    const std::vector<float> tolerance_m =
        required({{47.9f, 47.9f, 0, true}, {-47.9f, 47.9f, 5, false}, {47.9f, -47.9f, 5, false}});
    EXPECT_EQ(tolerance_m, (std::vector{0.5f, kWithdrawn, kWithdrawn}));
}

TEST(RequireEvidence, ToleranceGrowsWithDistance) {
    const auto isEvidence = [](float x_m, float y_m, float height_m) {
        return required({{x_m, y_m, height_m, true}}).front() == 0.5f;
    };
    for (const float side : {-1.0f, 1.0f}) {
        EXPECT_TRUE(isEvidence(0.1f, 0, side * 0.199f));
        EXPECT_FALSE(isEvidence(0.1f, 0, side * 0.202f));
        EXPECT_TRUE(isEvidence(12, -16, side * 0.299f));  // 20 m away
        EXPECT_FALSE(isEvidence(12, -16, side * 0.301f));
    }
}

TEST(RequireEvidence, OutsideGridHasNoEvidence) {
    // A pixel outside has no tolerance and provides no evidence for cells inside.
    for (const auto& [x_m, y_m] : {std::pair{48.1f, 0.0f},
                                   {-48.1f, 0.0f},
                                   {0.0f, 48.1f},
                                   {0.0f, -48.1f},
                                   {48.1f, -48.1f},
                                   {500.0f, 20.0f}}) {
        std::vector<Seen> pixels{{x_m, y_m, 0, true}, {0.97f * x_m, 0.97f * y_m, 5, false}};
        EXPECT_TRUE(allAre(kWithdrawn, required(pixels))) << x_m << " " << y_m;
        pixels.push_back({0.9f * x_m, 0.9f * y_m, 0, true});
        EXPECT_EQ(required(pixels).front(), kWithdrawn) << x_m << " " << y_m;
    }
}

TEST(RequireEvidence, IgnoresEmptyPixels) {
    const Seen empty{kNoValue, kNoValue, kNoValue, false};
    std::vector<Seen> pixels = closePixels(4, 4);
    for (int i = 0; i < 8; ++i) pixels.push_back(empty);
    const std::vector<float> tolerance_m = required(pixels, 4);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(tolerance_m[i], 0.5f);
    for (std::size_t i = 4; i < 12; ++i) EXPECT_FALSE(hasValue(tolerance_m[i]));
    for (const float t_m : required({empty, empty})) EXPECT_FALSE(hasValue(t_m));
}

}  // namespace
}  // namespace hagen
