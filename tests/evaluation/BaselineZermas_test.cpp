#include <gtest/gtest.h>
#include <hagen/evaluation/BaselineZermas.h>
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

const SensorModel kSensor = sensorModel("VLP-16");

/// The share of returns within the zone whose label is the true one.
double shareRight(const LabelledScan& scene, const std::vector<Label>& labels) {
    int right = 0, all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (scene.scan.range_m[i] > 20.0f) continue;
        ++all;
        right += labels[i] == scene.truth[i];
    }
    return static_cast<double>(right) / all;
}

Scan scanOf(const std::vector<Eigen::Vector3f>& points_m) {
    return test::scanOf(kSensor, points_m);
}

Eigen::Vector3f at(int row, double azimuth_deg, double range_m) {
    return test::onBeam(kSensor, row, azimuth_deg, range_m);
}

std::vector<std::int32_t> clustersOf(const Scan& scan) {
    return scanLineRuns(scan, kSensor, std::vector<Label>(scan.size(), Label::Roi));
}

TEST(ZermasGroundFit, TellsAPoleAndAWallFromFlatGround) {
    SimpleScene scene;
    scene.poles.push_back({6.0, 3.0, 0.3, 4.0});
    scene.boxes.push_back({{-9.0, -8.0, 0.0}, {-8.5, 8.0, 3.0}});
    const LabelledScan labelled = test::scanScene(scene, kSensor, 720, {0.0, 0.0, 1.5});
    const std::vector<Label> labels = zermasLabels(labelled.scan, kSensor);
    // Only what stands lower than Th_dist above the ground can be wrong.
    EXPECT_GT(shareRight(labelled, labels), 0.97);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const bool is_near = labelled.scan.range_m[i] <= 20.0f;
        if (!is_near || std::abs(labelled.scan.z_m[i] - (-1.5f + 0.2f)) < 0.05f) continue;
        const bool is_high = labelled.scan.z_m[i] > -1.5f + 0.2f;
        EXPECT_EQ(labels[i], is_high ? Label::Roi : Label::Rou)
            << "at height " << labelled.scan.z_m[i] + 1.5f;
    }
}

TEST(ZermasGroundFit, FollowsAPlaneThatTilts) {
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
        EXPECT_EQ(zermasLabels(scanOf(points_m), kSensor), truth) << uphill_deg;
    }
}

TEST(ZermasGroundFit, FitsAPlaneToEachStretch) {
    // Level, then 20 percent up: three planes can follow, one cannot.
    std::vector<Eigen::Vector3f> points_m;
    for (float x = -15.0f; x <= 15.0f; x += 0.5f) {
        for (int y = -10; y <= 10; ++y) {
            points_m.emplace_back(x, y, -1.5f + 0.2f * std::max(0.0f, x - 5.0f));
        }
    }
    ZermasOptions options;
    const auto groundWith = [&](int segments) {
        options.segments = segments;
        const std::vector<Label> labels = zermasLabels(scanOf(points_m), kSensor, options);
        return static_cast<double>(std::count(labels.begin(), labels.end(), Label::Rou)) /
               static_cast<double>(labels.size());
    };
    EXPECT_GT(groundWith(3), 0.99);
    EXPECT_LT(groundWith(1), 0.9);
}

TEST(ZermasGroundFit, LeavesFarAndUnseenReturnsOut) {
    const Scan scan = scanOf({{25.0f, 0.0f, 2.0f}, {0.1f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}});
    EXPECT_EQ(zermasLabels(scan, kSensor),
              (std::vector<Label>{Label::Rou, Label::Unclassified, Label::Unclassified}));
    EXPECT_EQ(zermasGroundFit(scan, kSensor), std::vector<Label>(3, Label::Unclassified));
}

TEST(ZermasGroundFit, CallsRoiWhatHasNoPlane) {
    const Scan line = scanOf({{3.0f, 0.0f, -1.0f}, {4.0f, 0.0f, -1.0f}, {5.0f, 0.0f, -1.0f}});
    ZermasOptions options;
    options.segments = 1;
    EXPECT_EQ(zermasLabels(line, kSensor, options), std::vector<Label>(3, Label::Roi));
    EXPECT_EQ(zermasLabels(scanOf({{3.0f, 0.0f, -1.0f}}), kSensor),
              std::vector<Label>(1, Label::Roi));
}

TEST(ZermasGroundFit, RefusesOptionsThatMeanNothing) {
    for (int ZermasOptions::*const count :
         {&ZermasOptions::segments, &ZermasOptions::iterations, &ZermasOptions::lowest_points}) {
        ZermasOptions options;
        options.*count = 0;
        EXPECT_THROW(zermasLabels({}, kSensor, options), std::invalid_argument);
    }
}

TEST(ScanLineRuns, JoinsWithinALineUpToTheRunDistance) {
    const auto gap_deg = [](double gap_m) { return degrees(2.0 * std::asin(gap_m / 2.0 / 10.0)); };
    const auto clusters = [&](double gap_m) {
        return clustersOf(scanOf({at(7, 30.0, 10.0), at(7, 30.0 + gap_deg(gap_m), 10.0f)}));
    };
    EXPECT_EQ(clusters(0.48), (std::vector<std::int32_t>{1, 1}));
    EXPECT_EQ(clusters(0.52), (std::vector<std::int32_t>{1, 2}));
}

TEST(ScanLineRuns, JoinsAdjacentLinesUpToTheMergeDistance) {
    // Two degrees apart: 0.87 m at 25 m, 1.05 m at 30 m.
    EXPECT_EQ(clustersOf(scanOf({at(7, 0.0, 25.0), at(8, 0.0, 25.0)})),
              (std::vector<std::int32_t>{1, 1}));
    EXPECT_EQ(clustersOf(scanOf({at(7, 0.0, 30.0), at(8, 0.0, 30.0)})),
              (std::vector<std::int32_t>{1, 2}));
    // The line between them has nothing: they never meet, as in the paper.
    EXPECT_EQ(clustersOf(scanOf({at(7, 0.0, 5.0), at(9, 0.0, 5.0)})),
              (std::vector<std::int32_t>{1, 2}));
}

TEST(ScanLineRuns, ClosesTheLineBehindTheSensor) {
    EXPECT_EQ(clustersOf(scanOf({at(7, 179.5, 10.0), at(7, -179.5, 10.0)})),
              (std::vector<std::int32_t>{1, 1}));
    EXPECT_EQ(clustersOf(scanOf({at(8, 179.5, 10.0), at(7, -179.5, 10.0)})),
              (std::vector<std::int32_t>{1, 1}));
}

TEST(ScanLineRuns, MergesClustersThatMeetLater) {
    // Two legs of a gate, and the bar below that joins them.
    std::vector<Eigen::Vector3f> points_m;
    for (int row = 8; row <= 10; ++row) {
        points_m.push_back(at(row, 0.0, 6.0));
        points_m.push_back(at(row, 20.0, 6.0));
    }
    EXPECT_EQ(clustersOf(scanOf(points_m)), (std::vector<std::int32_t>{1, 2, 1, 2, 1, 2}));
    for (double azimuth_deg = 0.0; azimuth_deg <= 20.0; azimuth_deg += 2.0) {
        points_m.push_back(at(7, azimuth_deg, 6.0));
    }
    const std::vector<std::int32_t> clusters = clustersOf(scanOf(points_m));
    EXPECT_EQ(clusters, std::vector<std::int32_t>(points_m.size(), 1));
}

TEST(ScanLineRuns, NumbersRoiReturnsAlone) {
    const Scan scan = scanOf({at(7, 0.0, 5.0), at(7, 90.0, 5.0), at(7, 180.0, 5.0)});
    EXPECT_EQ(scanLineRuns(scan, kSensor, {Label::Rou, Label::Roi, Label::Roi}),
              (std::vector<std::int32_t>{0, 1, 2}));
    EXPECT_THROW(scanLineRuns(scan, kSensor, {Label::Roi}), std::invalid_argument);
    EXPECT_TRUE(clustersOf({}).empty());
}

/// The same rules in every pair, and clusters by colouring until nothing changes.
std::vector<std::int32_t> clustersByBruteForce(const Scan& scan) {
    const int n = static_cast<int>(scan.size());
    const auto point = [&](int i) {
        return Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    };
    const auto isNextInLine = [&](int i, int j) {  // none of the line lies between, from i on
        const auto turn = [&](int to) {
            const float turn_rad = scan.azimuth_rad[to] - scan.azimuth_rad[i];
            return turn_rad > 0.0f ? turn_rad : turn_rad + static_cast<float>(2.0 * kPi);
        };
        for (int k = 0; k < n; ++k) {
            if (k != i && scan.row[k] == scan.row[i] && turn(k) < turn(j)) return false;
        }
        return true;
    };
    std::vector<std::pair<int, int>> links;
    for (int i = 0; i < n; ++i) {
        int nearest = -1;
        for (int j = 0; j < n; ++j) {
            const float apart_m = (point(i) - point(j)).norm();
            if (i != j && scan.row[i] == scan.row[j] && apart_m < 0.5f && isNextInLine(i, j)) {
                links.emplace_back(i, j);
            }
            const bool is_above = scan.row[j] == scan.row[i] + 1 && apart_m < 1.0f;
            if (is_above && (nearest < 0 || apart_m < (point(i) - point(nearest)).norm())) {
                nearest = j;
            }
        }
        if (nearest >= 0) links.emplace_back(i, nearest);
    }
    std::vector<std::int32_t> first(scan.size());
    for (int i = 0; i < n; ++i) first[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [i, j] : links) {
            const std::int32_t least = std::min(first[i], first[j]);
            changed = changed || first[i] != least || first[j] != least;
            first[i] = first[j] = least;
        }
    }
    std::vector<std::int32_t> numbers(scan.size());
    int count = 0;
    for (int i = 0; i < n; ++i) numbers[i] = first[i] == i ? ++count : numbers[first[i]];
    return numbers;
}

TEST(ScanLineRuns, AgreesWithBruteForce) {
    test::Random random(7);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<Eigen::Vector3f> points_m;
        const float most_m = random.real(1.0f, 8.0f);
        for (int i = 0; i < 60; ++i) {
            points_m.push_back(at(random.whole(5, 9),
                                  static_cast<double>(random.real(-180.0f, 180.0f)),
                                  static_cast<double>(random.real(0.6f, most_m))));
        }
        const Scan scan = scanOf(points_m);
        EXPECT_EQ(clustersOf(scan), clustersByBruteForce(scan)) << "trial " << trial;
    }
}

}  // namespace
}  // namespace hagen::evaluation
