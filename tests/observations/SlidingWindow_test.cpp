#include <gtest/gtest.h>
#include <hagen/observations/SlidingWindow.h>
#include <hagen/range_image/Angle.h>

#include <cmath>
#include <stdexcept>

#include "support/SimpleScene.h"

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;

Scan pointAt(float x, float y, float z) {
    Scan scan;
    scan.x_m = {x};
    scan.y_m = {y};
    scan.z_m = {z};
    scan.intensity = {0.5f};
    locateBeams(sensorModel("VLP-16"), scan);
    return scan;
}

TEST(SlidingWindow, OneScanIsTheScanItself) {
    SlidingWindow window(1);
    const SensorModel sensor = sensorModel("VLP-16");
    window.add(pointAt(9, 9, 9), CPose3D(), sensor);
    const Scan& scan = window.add(pointAt(5, 1, 0), CPose3D(1, 2, 3, 0.1, 0, 0), sensor);
    ASSERT_EQ(scan.size(), 1u);
    EXPECT_EQ(scan.x_m[0], 5.0f);
}

TEST(SlidingWindow, AFixedPointStaysAtOnePlaceAsTheSensorMovesAndTurns) {
    // The point (10, 2, 1) of the map, seen from three poses.
    const SensorModel sensor = sensorModel("VLP-16");
    const std::vector<CPose3D> poses{{0, 0, 0, 0, 0, 0},
                                     {2, -1, 0.5, radians(30), 0, 0},
                                     {3, 1, 0.2, radians(-20), radians(5), radians(-8)}};
    SlidingWindow window(3);
    const Scan* seen = nullptr;
    for (const CPose3D& pose : poses) {
        const auto local = pose.inverseComposePoint(mrpt::math::TPoint3D(10, 2, 1));
        seen = &window.add(pointAt(static_cast<float>(local.x), static_cast<float>(local.y),
                                   static_cast<float>(local.z)),
                           pose, sensor);
    }
    ASSERT_EQ(seen->size(), 3u);
    for (const std::size_t i : {1, 2}) {
        EXPECT_NEAR(seen->x_m[i], seen->x_m[0], 1e-5);
        EXPECT_NEAR(seen->y_m[i], seen->y_m[0], 1e-5);
        EXPECT_NEAR(seen->z_m[i], seen->z_m[0], 1e-5);
        EXPECT_NEAR(seen->range_m[i], seen->range_m[0], 1e-5);
        EXPECT_EQ(seen->row[i], seen->row[0]);
    }
}

TEST(SlidingWindow, KeepsTheNewestScanFirstAndForgetsTheOldest) {
    SlidingWindow window(2);
    const SensorModel sensor = sensorModel("VLP-16");
    window.add(pointAt(1, 0, 0), CPose3D(), sensor);
    window.add(pointAt(2, 0, 0), CPose3D(), sensor);
    const Scan& seen = window.add(pointAt(3, 0, 0), CPose3D(), sensor);
    EXPECT_EQ(seen.x_m, (std::vector<float>{3, 2}));
    EXPECT_EQ(seen.intensity, (std::vector<float>{0.5f, 0.5f}));
    EXPECT_EQ(seen.row.size(), 2u);
    window.clear();
    EXPECT_EQ(window.add(pointAt(4, 0, 0), CPose3D(), sensor).size(), 1u);
}

TEST(SlidingWindow, TheNewestScanKeepsTheBeamsItsSensorTold) {
    SlidingWindow window(2);
    const SensorModel sensor = sensorModel("VLP-16");
    window.add(pointAt(1, 0, 0), CPose3D(), sensor);
    Scan told = pointAt(5, 0, 0);
    told.row = {3};  // differs from the row of its coordinates
    EXPECT_EQ(window.add(told, CPose3D(), sensor).row[0], 3);
}

TEST(SlidingWindow, OfAPlaneIsThatPlane) {
    const SensorModel sensor = sensorModel("VLP-16");
    SlidingWindow window(5);
    const Scan* seen = nullptr;
    for (int i = 0; i < 5; ++i) {
        const double x = 0.8 * i, height = 2.0 + 0.1 * i;
        seen = &window.add(test::scanScene({}, sensor, 360, {x, 0, height}).scan,
                           CPose3D(x, 0, height, 0, 0, 0), sensor);
    }
    for (const float z_m : seen->z_m) ASSERT_NEAR(z_m, -2.4f, 1e-4f);
}

TEST(SlidingWindow, HoldsAtLeastOneScan) {
    EXPECT_THROW(SlidingWindow(0), std::invalid_argument);
    EXPECT_THROW(SlidingWindow(-1), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::observations
