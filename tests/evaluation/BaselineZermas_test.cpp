#include "evaluation/baselines/BaselineZermas.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/PointScan.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen::evaluation {
namespace {

using test::LabelledScan;
using test::SimpleScene;

const SensorModel kZermasSensor = sensorModel("VLP-16");

/// Share of returns within the zone that are labelled correctly.
double shareRight(const LabelledScan& scene, const std::vector<Label>& labels) {
    int right = 0, all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (scene.scan.range_m[i] > 20.0f) continue;
        ++all;
        right += labels[i] == scene.truth[i];
    }
    return static_cast<double>(right) / all;
}

Scan zermasScanOf(const std::vector<Eigen::Vector3f>& points_m) {
    return test::scanOf(kZermasSensor, points_m);
}

TEST(ZermasGroundFit, SeparatesObstaclesFromFlatGround) {
    const SimpleScene scene =
        test::sceneOf({{{-9.0, -8.0, 0.0}, {-8.5, 8.0, 3.0}}}, {{6.0, 3.0, 0.3, 4.0}});
    const LabelledScan labelled = test::scanScene(scene, kZermasSensor, 720, {0.0, 0.0, 1.5});
    const std::vector<Label> labels = zermasLabels(labelled.scan, kZermasSensor);
    // Only returns near the height threshold Th_dist may be wrong.
    EXPECT_GT(shareRight(labelled, labels), 0.97);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const bool is_near = labelled.scan.range_m[i] <= 20.0f;
        if (!is_near || std::abs(labelled.scan.z_m[i] - (-1.5f + 0.2f)) < 0.05f) continue;
        const bool is_high = labelled.scan.z_m[i] > -1.5f + 0.2f;
        EXPECT_EQ(labels[i], is_high ? Label::Roi : Label::Rou)
            << "at height " << labelled.scan.z_m[i] + 1.5f;
    }
}

TEST(ZermasGroundFit, FitsTiltedPlane) {
    const double slope = std::tan(radians(5.0));
    for (int uphill_deg = 0; uphill_deg < 360; uphill_deg += 15) {
        const Eigen::Vector3d uphill = test::directionOf(radians(uphill_deg), 0.0);
        const auto onPlane = [&](double x_m, double y_m, double above_m) -> Eigen::Vector3f {
            const double rise_m = slope * (uphill.x() * x_m + uphill.y() * y_m);
            return Eigen::Vector3d(x_m, y_m, -1.5 + rise_m + above_m).cast<float>();
        };
        std::vector<Eigen::Vector3f> points_m;
        std::vector<Label> truth;
        for (int x = -15; x <= 15; ++x) {
            for (int y = -12; y <= 12; ++y) {
                points_m.push_back(onPlane(x, y + 0.1, 0.0));
                truth.push_back(Label::Rou);
            }
        }
        for (int height = 1; height <= 6; ++height) {  // a post on the slope
            points_m.push_back(onPlane(8.0, 0.0, 0.3 * height));
            truth.push_back(Label::Roi);
        }
        EXPECT_EQ(zermasLabels(zermasScanOf(points_m), kZermasSensor), truth) << uphill_deg;
    }
}

TEST(ZermasGroundFit, FitsOnePlanePerSegment) {
    // Level ground, then a rise of 20 percent: three planes can follow it, one cannot.
    std::vector<Eigen::Vector3f> points_m;
    for (float x = -15.0f; x <= 15.0f; x += 0.5f) {
        for (int y = -10; y <= 10; ++y) {
            points_m.emplace_back(x, y, -1.5f + 0.2f * std::max(0.0f, x - 5.0f));
        }
    }
    ZermasOptions options;
    const auto groundWith = [&](int segments) {
        options.segments = segments;
        const std::vector<Label> labels =
            zermasLabels(zermasScanOf(points_m), kZermasSensor, options);
        return static_cast<double>(std::count(labels.begin(), labels.end(), Label::Rou)) /
               static_cast<double>(labels.size());
    };
    EXPECT_GT(groundWith(3), 0.99);
    EXPECT_LT(groundWith(1), 0.9);
}

TEST(ZermasGroundFit, IgnoresFarAndUnseenReturns) {
    const Scan scan = zermasScanOf({{25.0f, 0.0f, 2.0f}, {0.1f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}});
    EXPECT_EQ(zermasLabels(scan, kZermasSensor),
              (std::vector<Label>{Label::Rou, Label::Unclassified, Label::Unclassified}));
    EXPECT_EQ(zermasGroundFit(scan, kZermasSensor), std::vector<Label>(3, Label::Unclassified));
}

TEST(ZermasGroundFit, LabelsRoiWithoutPlane) {
    const Scan line = zermasScanOf({{3.0f, 0.0f, -1.0f}, {4.0f, 0.0f, -1.0f}, {5.0f, 0.0f, -1.0f}});
    ZermasOptions options;
    options.segments = 1;
    EXPECT_EQ(zermasLabels(line, kZermasSensor, options), std::vector<Label>(3, Label::Roi));
    EXPECT_EQ(zermasLabels(zermasScanOf({{3.0f, 0.0f, -1.0f}}), kZermasSensor),
              std::vector<Label>(1, Label::Roi));
}

TEST(ZermasGroundFit, RejectsCountsBelowOne) {
    for (int ZermasOptions::*const count :
         {&ZermasOptions::segments, &ZermasOptions::iterations, &ZermasOptions::lowest_points}) {
        ZermasOptions options;
        options.*count = 0;
        EXPECT_THROW(zermasLabels({}, kZermasSensor, options), std::invalid_argument);
    }
}

}  // namespace
}  // namespace hagen::evaluation
