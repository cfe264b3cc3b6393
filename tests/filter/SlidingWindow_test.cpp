#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/filter/SlidingWindow.h>
#include <hagen/scan/Angle.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d poseAt(const Vector3d& position_m, double roll_deg = 0) {
    return Eigen::Translation3d(position_m) *
           Eigen::AngleAxisd(radians(roll_deg), Vector3d::UnitX());
}

test::LabelledScan scanAt(const Isometry3d& pose, const test::SimpleScene& scene = test::yard(),
                          const char* sensor = "VLP-16") {
    return test::scanScene(scene, sensorModel(sensor), 360, pose.translation(), pose.linear());
}

/// A frame of 20 000 random directions within a Mid-360's field of view, upside down.
test::LabelledScan randomFrame(const test::SimpleScene& scene, const Vector3d& position_m,
                               test::Random& random) {
    const SensorModel sensor = sensorModel("Mid-360");
    test::LabelledScan seen;
    for (int k = 0; k < 20000; ++k) {
        const Vector3d direction =
            test::directionOf(radians(static_cast<double>(random.real(-180, 180))),
                              radians(static_cast<double>(random.real(-7, 52))));
        const auto hit =
            test::castRay(scene, position_m, direction.cwiseProduct(Vector3d(1, -1, -1)));
        if (!(hit.range_m < 60)) continue;
        const Eigen::Vector3f point_m = (hit.range_m * direction).cast<float>();
        seen.scan.x_m.push_back(point_m.x());
        seen.scan.y_m.push_back(point_m.y());
        seen.scan.z_m.push_back(point_m.z());
        seen.truth.push_back(hit.label);
    }
    seen.scan.intensity.resize(seen.scan.size());
    locateBeams(sensor, seen.scan);
    return seen;
}

SlidingWindow windowOf(int scans, const char* sensor = "VLP-16", Options options = {}) {
    options.window_scans = scans;
    options.columns = 360;
    return SlidingWindow(HagenFilter(sensorModel(sensor), options));
}

TEST(SlidingWindow, OneScanEqualsFilter) {
    SlidingWindow window = windowOf(1);
    HagenFilter filter = window.filter();
    for (const double x_m : {0.0, 0.5}) {
        const Scan scan = scanAt(poseAt({x_m, 0, 2})).scan;
        EXPECT_EQ(window.segment(scan).returns.label, filter.segment(scan).returns.label);
        EXPECT_EQ(&window.labelled(), &scan);
    }
}

// The same world point, seen from three poses, has three returns in the frame of the newest.
TEST(SlidingWindow, MovesOlderScansByPoses) {
    Options options;
    options.label_window = true;
    options.window_fills_gaps = false;
    SlidingWindow window = windowOf(3, "VLP-16", options);
    const std::vector<Isometry3d> poses{poseAt({0, 0, 2}), poseAt({0.5, 0.1, 2.1}, 3),
                                        poseAt({1, 0.2, 1.9}, -2), poseAt({1.5, 0, 2}, 5)};
    std::vector<Scan> scans;
    for (const Isometry3d& pose : poses) {
        scans.push_back(scanAt(pose).scan);
        window.segment(scans.back(), {}, pose);
    }
    EXPECT_EQ(window.olderScans(), 2u);
    EXPECT_EQ(window.scansWithoutMotion(), 0u);
    const Scan& all = window.labelled();
    ASSERT_EQ(all.size(), scans[3].size() + scans[2].size() + scans[1].size());
    std::size_t i = 0;
    for (const int k : {3, 2, 1}) {
        for (std::size_t n = 0; n < scans[k].size(); ++n, ++i) {
            const Vector3d expected_m = poses[3].inverse() * poses[k] *
                                        Vector3d(scans[k].x_m[n], scans[k].y_m[n], scans[k].z_m[n]);
            const Vector3d moved_m(all.x_m[i], all.y_m[i], all.z_m[i]);
            ASSERT_LT((moved_m - expected_m).norm(), 1e-4) << k << " " << n;
        }
    }
}

TEST(SlidingWindow, LabelsOnlyTheNewestByDefault) {
    SlidingWindow window = windowOf(5);
    for (const double x_m : {0.0, 0.5, 1.0}) {
        const Isometry3d pose = poseAt({x_m, 0, 2});
        const Scan scan = scanAt(pose).scan;
        EXPECT_EQ(window.segment(scan, {}, pose).returns.label.size(), scan.size());
    }
}

// The closest return of the concatenated cloud counts, by brute force.
TEST(SlidingWindow, ClosestReturnOfAllScansCounts) {
    Options options;
    options.window_fills_gaps = false;
    SlidingWindow window = windowOf(2, "VLP-16", options);
    window.segment(scanAt(poseAt({0, 0, 2}), test::sceneOf({{{5, -2, 0}, {6, 2, 3}}})).scan, {},
                   poseAt({0, 0, 2}));
    const Scan gone = scanAt(poseAt({0, 0, 2}), test::sceneOf({})).scan;
    const SegmentationResult& r = window.segment(gone, {}, poseAt({0, 0, 2}));
    EXPECT_NEAR(r.range_image.depth_m(7, 180), 5, 0.1);  // the beam at -1 degree, forwards
    EXPECT_NEAR(r.range_image.depth_m(0, 0), 2 / std::sin(radians(15)), 0.1);
}

TEST(SlidingWindow, NewestScanDecidesItsPixels) {
    SlidingWindow window = windowOf(2);
    const Isometry3d pose = poseAt({0, 0, 2});
    window.segment(scanAt(pose, test::sceneOf({{{5, -2, 0}, {6, 2, 3}}})).scan, {}, pose);
    const Scan gone = scanAt(pose, test::sceneOf({})).scan;
    const SegmentationResult& r = window.segment(gone, {}, pose);
    EXPECT_NEAR(r.range_image.depth_m(5, 180), 2 / std::sin(radians(5)), 0.1);  // the ground behind
    EXPECT_NEAR(r.range_image.depth_m(8, 180), 5, 0.1);  // the newest scan sees nothing there
}

// Height and tilt come from the ground: the older scan's ground stays flat below the newest sensor.
TEST(SlidingWindow, MovesScansByGroundWithoutPoses) {
    Options options;
    options.label_window = true;
    SlidingWindow window = windowOf(2, "VLP-16", options);
    const auto ground = test::sceneOf({});
    window.segment(scanAt(poseAt({0, 0, 2}, 8), ground).scan);
    const Scan scan = scanAt(poseAt({0, 0, 1.5}), ground).scan;
    window.segment(scan);
    EXPECT_EQ(window.olderScans(), 1u);
    const Scan& all = window.labelled();
    ASSERT_GT(all.size(), scan.size());
    for (std::size_t i = scan.size(); i < all.size(); ++i) {
        if (std::hypot(all.x_m[i], all.y_m[i]) > 20) continue;
        EXPECT_NEAR(all.z_m[i], -1.5, 0.05);
    }
}

TEST(SlidingWindow, ReportsUnknownMotion) {
    const auto wall = test::sceneOf({{{3, -9, -9}, {4, 9, 9}}});
    test::SimpleScene no_ground = wall;
    no_ground.has_ground = false;
    const Scan scan = scanAt(poseAt({0, 0, 2}), no_ground).scan;
    for (const bool fills_gaps : {true, false}) {
        Options options;
        options.window_fills_gaps = fills_gaps;
        SlidingWindow window = windowOf(2, "VLP-16", options);
        window.segment(scan);
        window.segment(scan);
        EXPECT_EQ(window.scansWithoutMotion(), 1u);
        EXPECT_EQ(window.olderScans(), fills_gaps ? 0u : 1u);
        window.forget();
        window.segment(scan);
        EXPECT_EQ(window.scansWithoutMotion(), 0u);
    }
}

// A person crosses in front of the sensor: where the newest frame sees ground, it is ROU.
TEST(SlidingWindow, MoversLeaveNoTrail) {
    const Attitude upside_down{static_cast<float>(kPi), 0};
    Isometry3d pose = poseAt({0, 0, 2});
    pose.linear() = Vector3d(1, -1, -1).asDiagonal();
    for (const double speed_m_s : {1.0, 3.0, 10.0}) {
        test::Random random(5);
        SlidingWindow window = windowOf(5, "Mid-360"), alone = windowOf(1, "Mid-360");
        std::size_t ground = 0, roi = 0, roi_alone = 0;
        for (int frame = 0; frame < 8; ++frame) {
            const double y_m = speed_m_s * 0.1 * (frame - 4);
            const auto seen = randomFrame(
                test::sceneOf({{{4, y_m - 0.25, 0}, {4.4, y_m + 0.25, 1.8}}}), {0, 0, 2}, random);
            const std::vector<Label> labels =
                window.segment(seen.scan, upside_down, pose).returns.label;
            const std::vector<Label> labels_alone =
                alone.segment(seen.scan, upside_down).returns.label;
            for (std::size_t i = 0; i < labels.size(); ++i) {
                if (seen.truth[i] != Label::Rou || seen.scan.range_m[i] > 20) continue;
                ++ground;
                roi += labels[i] == Label::Roi;
                roi_alone += labels_alone[i] == Label::Roi;
            }
        }
        EXPECT_GT(ground, 50000u);
        EXPECT_LE(roi, roi_alone) << speed_m_s;
    }
}

}  // namespace
}  // namespace hagen
