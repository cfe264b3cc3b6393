#include "evaluation/baselines/BaselineBogoslavskyi.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>
#include <stdexcept>

#include "support/PointScan.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen::evaluation {
namespace {

using test::LabelledScan;
using test::SimpleScene;

const SensorModel kVlp16 = sensorModel("VLP-16");

Scan scanOf(const std::vector<Eigen::Vector3f>& points_m) { return test::scanOf(kVlp16, points_m); }

Eigen::Vector3f at(int row, double azimuth_deg, double range_m) {
    return test::onBeam(kVlp16, row, azimuth_deg, range_m);
}

TEST(SavitzkyGolay, UsesPublishedWeights) {
    Image<float> impulse = Image<float>::Zero(9, 1);
    impulse(4, 0) = 35.0f;  // Savitzky and Golay 1964: -3 12 17 12 -3, over 35
    const Image<float> smooth = savitzkyGolay(impulse, 5);
    const std::vector<float> expected{0, 0, -3, 12, 17, 12, -3, 0, 0};
    for (int row = 0; row < 9; ++row) EXPECT_NEAR(smooth(row, 0), expected[row], 1e-4) << row;
}

TEST(SavitzkyGolay, KeepsParabolas) {
    Image<float> image(12, 2);
    for (int row = 0; row < 12; ++row) {
        const float r = static_cast<float>(row);
        image.row(row) << 0.3f * r * r - 2.0f * r + 1.0f, -0.1f * r * r;
    }
    for (const int window : {3, 5, 7, 11}) {
        EXPECT_LT((savitzkyGolay(image, window) - image).abs().maxCoeff(), 1e-3f) << window;
    }
}

TEST(SavitzkyGolay, KeepsPixelsNearGapsAndEdges) {
    test::Random random(3);
    Image<float> image = random.image(12, 1, 0.0f, 1.0f, 0.0);
    image(6, 0) = kNoValue;
    const Image<float> smooth = savitzkyGolay(image, 5);
    for (const int row : {0, 1, 4, 5, 7, 8, 10, 11}) EXPECT_EQ(smooth(row, 0), image(row, 0));
    EXPECT_FALSE(hasValue(smooth(6, 0)));
    for (const int row : {2, 3, 9}) EXPECT_NE(smooth(row, 0), image(row, 0)) << row;
    EXPECT_TRUE(test::same(savitzkyGolay(image, 1), image));
}

TEST(SavitzkyGolay, RejectsEvenWindows) {
    for (const int window : {-1, 0, 4}) {
        EXPECT_THROW(savitzkyGolay(Image<float>::Zero(5, 5), window), std::invalid_argument);
    }
}

/// Share of the near returns with this true label that are labelled correctly.
double recall(const LabelledScan& scene, const std::vector<Label>& labels, Label label) {
    int hits = 0, all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (scene.scan.range_m[i] > 20.0f || scene.truth[i] != label) continue;
        ++all;
        hits += labels[i] == label;
    }
    return static_cast<double>(hits) / all;
}

TEST(BogoslavskyiLabels, SeparatesObstaclesFromFlatGround) {
    const SimpleScene scene =
        test::sceneOf({{{-9.0, -8.0, 0.0}, {-8.5, 8.0, 3.0}}}, {{6.0, 3.0, 0.3, 4.0}});
    const LabelledScan labelled = test::scanScene(scene, kVlp16, 870, {0.0, 0.0, 1.5});
    const std::vector<Label> labels = bogoslavskyiLabels(labelled.scan, kVlp16);
    EXPECT_EQ(recall(labelled, labels, Label::Roi), 1.0);
    // The slope to an obstacle is stored in the ground row at its foot.
    EXPECT_GT(recall(labelled, labels, Label::Rou), 0.95);
}

TEST(BogoslavskyiLabels, SmoothsAngles) {
    // The angles have a step at a box's foot, which smoothing spreads to its neighbours.
    const SimpleScene scene = test::sceneOf({{{4.0, -3.0, 0.0}, {5.0, 3.0, 1.0}}});
    const LabelledScan labelled = test::scanScene(scene, kVlp16, 870, {0.0, 0.0, 1.5});
    BogoslavskyiOptions rough;
    rough.smoothing_window = 1;
    EXPECT_NE(bogoslavskyiLabels(labelled.scan, kVlp16),
              bogoslavskyiLabels(labelled.scan, kVlp16, rough));
    rough.smoothing_window = 4;
    EXPECT_THROW(bogoslavskyiLabels(labelled.scan, kVlp16, rough), std::invalid_argument);
}

TEST(BogoslavskyiLabels, StartsFromFlatLowestPixels) {
    // A surrounding step, steeper than 45 degrees at the lowest beam, so nothing starts there.
    const Eigen::Vector3f low = at(0, 10.0, 5.0), high = at(1, 10.0, 5.0);
    std::vector<Eigen::Vector3f> column{low, high};
    EXPECT_EQ(bogoslavskyiLabels(scanOf(column), kVlp16), std::vector<Label>(2, Label::Roi));
    // Level ground: both pixels have the same height.
    const double rise = std::sin(radians(15.0)) / std::sin(radians(13.0));
    column[1] = at(1, 10.0, 5.0 * rise);
    EXPECT_EQ(bogoslavskyiLabels(scanOf(column), kVlp16), std::vector<Label>(2, Label::Rou));
}

TEST(BogoslavskyiLabels, GrowsUpToAngleDifference) {
    // Level from beam 0 to 1, then a slope from 1 to 2: ground if below 5 degrees.
    const auto labelsOf = [&](double slope_deg) {
        const double z_m = -1.5;
        const auto groundRange = [&](double beam_deg) { return z_m / std::sin(radians(beam_deg)); };
        const double from_m = groundRange(-13.0) * std::cos(radians(13.0));
        // The point on the slope: r sin e = z + tan s (r cos e - from).
        const double t = std::tan(radians(slope_deg)), e = radians(-11.0);
        const double range_m = (z_m - t * from_m) / (std::sin(e) - t * std::cos(e));
        return bogoslavskyiLabels(scanOf({at(0, 0.0, groundRange(-15.0)),
                                          at(1, 0.0, groundRange(-13.0)), at(2, 0.0, range_m)}),
                                  kVlp16);
    };
    EXPECT_EQ(labelsOf(4.5), std::vector<Label>(3, Label::Rou));
    EXPECT_EQ(labelsOf(5.5), (std::vector<Label>{Label::Rou, Label::Roi, Label::Roi}));
}

TEST(BogoslavskyiLabels, IgnoresFarAndUnseenReturns) {
    const Scan scan = scanOf({at(9, 0.0, 25.0), at(9, 90.0, 0.1), {0.0f, 0.0f, 0.0f}});
    EXPECT_EQ(bogoslavskyiLabels(scan, kVlp16),
              (std::vector<Label>{Label::Rou, Label::Unclassified, Label::Unclassified}));
    EXPECT_TRUE(bogoslavskyiLabels({}, kVlp16).empty());
}

}  // namespace
}  // namespace hagen::evaluation
