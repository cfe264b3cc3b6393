#include "filter/simd/HeightLabels.h"
#include <gtest/gtest.h>
#include "filter/simd/ObstacleFeet.h"
#include "filter/simd/SpeckRemoval.h"

#include <utility>
#include <vector>

#include "support/GroundPixels.h"

namespace hagen {
namespace {

using test::kEmptyPixel;
using test::pixelsAt;

/// Tolerances over the plane z = 0, so that a pixel's height is its z.
Image<float> toleratedHeights(const PixelPoints& pixels, const HeightTolerance& tolerance = {},
                              float sensor_height_m = 1) {
    static ToleranceWorkspace work;  // reused, as in a filter
    Image<float> tolerance_m;
    CellTops tops;
    PixelCells cells;
    findPixelCells(pixels, cells);
    findCellTops(cells, pixels.z_m, tops);
    toleratedHeights(pixels, cells, tops, tolerance, sensor_height_m, tolerance_m, work);
    return tolerance_m;
}

TEST(HeightTolerance, GrowsWithDistance) {
    const Image<float> tolerance_m =
        toleratedHeights(pixelsAt({{0, 0, 0}, {3, 4, 0}, {-40, 0, 0}, kEmptyPixel}));
    EXPECT_FLOAT_EQ(tolerance_m(0, 0), 0.17f);
    EXPECT_FLOAT_EQ(tolerance_m(0, 1), 0.195f);  // 0.17 + 0.005 * 5
    EXPECT_FLOAT_EQ(tolerance_m(0, 2), 0.37f);
    EXPECT_FALSE(hasValue(tolerance_m(0, 3)));
}

TEST(HeightTolerance, IsAtLeastFourCentimetres) {
    const Image<float> tolerance_m =
        toleratedHeights(pixelsAt({{3, 4, 0}, {3, 4, 1.4f}, {3, 4, 1.4f}}), {0.1f, 0.0f, 0.12f});
    EXPECT_FLOAT_EQ(tolerance_m(0, 0), 0.04f);
}

TEST(HeightTolerance, IgnoresLoneHighReturns) {
    EXPECT_FLOAT_EQ(toleratedHeights(pixelsAt({{3, 4, 0}, {3, 4, 1}}))(0, 0), 0.195f);
    EXPECT_FLOAT_EQ(toleratedHeights(pixelsAt({{3, 4, 0}, {3, 4, 1}, {3, 4, 0.5f}}))(0, 0),
                    0.195f - 0.12f * 0.5f);
}

TEST(LabelByHeight, OutsideToleranceIsRoi) {
    Image<float> height_m(1, 6), tolerance_m(1, 6);
    height_m << -1.51f, -1.5f, 0.2f, 0.21f, 5, kNoValue;
    tolerance_m << 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, kNoValue;
    Image<Label> labels, expected(1, 6);
    labelByHeight(height_m, tolerance_m, labels);
    expected << Label::Roi, Label::Rou, Label::Rou, Label::Roi, Label::Roi, Label::Unclassified;
    EXPECT_TRUE((labels == expected).all());
}

/// The labels of a column over the plane z = 0 after growing feet, lowest row first. The initial
/// labels use a tolerance of 0.2 m.
std::vector<Label> grown(const std::vector<Eigen::Vector3f>& column) {
    const PixelPoints pixels = pixelsAt(column, static_cast<int>(column.size()));
    static FeetWorkspace work;
    Image<Label> labels;
    labelByHeight(pixels.z_m, Image<float>::Constant(pixels.z_m.rows(), 1, 0.2f).eval(), labels);
    growFeet(pixels, pixels.z_m, labels, work);
    return {labels.data(), labels.data() + labels.size()};
}

constexpr Label kRoi = Label::Roi, kRou = Label::Rou, kNone = Label::Unclassified;

TEST(GrowFeet, FollowsObstaclesDownToGround) {
    const Eigen::Vector3f none = kEmptyPixel, top(8, 0, 1);
    const std::pair<std::vector<Eigen::Vector3f>, std::vector<Label>> cases[] = {
        {{{3, 0, 0}, {8, 0, 0.05f}, {8, 0, 0.15f}, {8, 0, 0.5f}}, {kRou, kRoi, kRoi, kRoi}},
        {{{5, 0, 0.15f}, {8, 0, 0.5f}}, {kRou, kRoi}},            // grass before a wall
        {{{7.61f, 0, 0.1f}, {8, 0, 0.5f}}, {kRoi, kRoi}},         // steeper than 45 degrees
        {{{7.59f, 0, 0.1f}, {8, 0, 0.5f}}, {kRou, kRoi}},         // flatter
        {{{0, 7.59f, 0.1f}, {0, 8, 0.5f}}, {kRou, kRoi}},         // in any direction
        {{{8, 0, 0.015f}, {8, 0, 0.5f}}, {kRou, kRoi}},           // at ground level
        {{{8, 0, 0.016f}, {8, 0, 0.5f}}, {kRoi, kRoi}},           // above it
        {{{8, 0, 0.05f}, {8, 0, 0.15f}}, {kRou, kRou}},           // no obstacle above
        {{{8, 0, 0.1f}, {5, 0, 0.1f}, top}, {kRou, kRou, kRoi}},  // ground in between
        {{{8, 0, 0.1f}, none, none, none, top}, {kRoi, kNone, kNone, kNone, kRoi}},
        {{{8, 0, 0.1f}, none, none, none, none, top}, {kRou, kNone, kNone, kNone, kNone, kRoi}},
    };
    for (const auto& [column, expected] : cases) {
        EXPECT_EQ(grown(column), expected) << column.front().transpose();
    }
}

/// Labels of 3 x 5 pixels that differ only in their height over the plane z = 0, after removing
/// specks; the tolerance is 0.2 m.
Image<Label> voted(const Image<float>& height_m, float distance_step_m = 0) {
    PixelPoints pixels{Image<float>(3, 5), Image<float>::Zero(3, 5), height_m};
    for (int column = 0; column < 5; ++column) {
        pixels.x_m.col(column) = 10.0f + distance_step_m * static_cast<float>(column);
    }
    pixels.x_m = height_m.isNaN().select(kNoValue, pixels.x_m);
    const Image<float> tolerance_m = Image<float>::Constant(3, 5, 0.2f);
    static SpeckWorkspace work;
    Image<Label> labels;
    labelByHeight(height_m, tolerance_m, labels);
    removeSpecks(pixels, height_m, tolerance_m, labels, work);
    return labels;
}

TEST(RemoveSpecks, DoubtfulPixelsFollowNeighbours) {
    Image<float> height_m = Image<float>::Zero(3, 5);
    height_m(1, 2) = 0.39f;
    EXPECT_TRUE((voted(height_m) == kRou).all());
    height_m.setConstant(0.6f);
    height_m(1, 2) = 0.01f;
    EXPECT_TRUE((voted(height_m) == kRoi).all());
}

TEST(RemoveSpecks, KeepsClearlyHighPixels) {
    Image<float> height_m = Image<float>::Zero(3, 5);
    height_m(1, 2) = 0.41f;
    EXPECT_EQ(voted(height_m)(1, 2), kRoi);
    height_m(1, 2) = 4;  // a wire
    EXPECT_EQ(voted(height_m)(1, 2), kRoi);
    EXPECT_EQ((voted(height_m) == kRoi).count(), 1);
}

TEST(RemoveSpecks, TieKeepsLabel) {
    Image<float> height_m = Image<float>::Constant(3, 5, kNoValue);
    height_m(1, 2) = 0.3f;  // doubtful, RoI
    height_m(0, 1) = 2;     // votes for RoI
    height_m(2, 2) = height_m(2, 3) = 0;
    EXPECT_EQ(voted(height_m)(1, 2), kRoi);
    height_m(1, 3) = 0;  // votes: 2 to 3
    EXPECT_EQ(voted(height_m)(1, 2), kRou);
}

TEST(RemoveSpecks, NeedsThreeVotes) {
    Image<float> height_m = Image<float>::Constant(3, 5, kNoValue);
    height_m(1, 2) = 0.1f;  // doubtful, ROU
    height_m(0, 2) = 2;
    EXPECT_EQ(voted(height_m)(1, 2), kRou);
    height_m(2, 1) = 2;
    EXPECT_EQ(voted(height_m)(1, 2), kRoi);
}

TEST(RemoveSpecks, IgnoresPixelsBeyondOneMetre) {
    Image<float> height_m = Image<float>::Zero(3, 5);
    height_m.col(2) = 0.3f;
    EXPECT_TRUE((voted(height_m, 0.9f).col(2) == kRou).all());
    EXPECT_TRUE((voted(height_m, 1.1f).col(2) == kRoi).all());
}

TEST(RemoveSpecks, CountsLabelsBeforeVoting) {
    Image<float> height_m = Image<float>::Constant(3, 5, kNoValue);
    height_m.col(0) = 0.0f;
    height_m(1, 1) = 0.3f;  // votes 2 to 4, becomes ROU
    height_m(1, 2) = 0.3f;  // votes 2 to 1, as the left one is still RoI
    height_m(0, 2) = 0.0f;
    const Image<Label> labels = voted(height_m);
    EXPECT_EQ(labels(1, 1), kRou);
    EXPECT_EQ(labels(1, 2), kRoi);
}

TEST(RemoveSpecks, NeighboursWrapInAzimuthOnly) {
    Image<float> height_m = Image<float>::Constant(3, 5, kNoValue);
    height_m(1, 0) = 0.3f;
    height_m(0, 4) = height_m(1, 4) = height_m(2, 4) = 0;
    EXPECT_EQ(voted(height_m)(1, 0), kRou);
    height_m.setConstant(kNoValue);
    height_m(0, 2) = 0.3f;
    height_m(2, 1) = height_m(2, 2) = height_m(2, 3) = 0;
    EXPECT_EQ(voted(height_m)(0, 2), kRoi);
}

}  // namespace
}  // namespace hagen
