#include <gtest/gtest.h>
#include <hagen/filter/PixelPoints.h>

#include <cmath>

#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen {
namespace {

constexpr int kPixelColumns = 360;

struct Located {
    Scan scan;
    RangeImage image;
    Image<float> depth_m;
    PixelPoints pixels;
};

/// The pixels of a scan of these points; `fill` repairs gaps in its depth image.
template <class Fill>
Located located(const SensorModel& sensor, const std::vector<Eigen::Vector3f>& points_m,
                Fill fill) {
    static ProjectionWorkspace work;
    Located l;
    l.scan = test::scanOf(sensor, points_m);
    projectScan(l.scan, sensor, kPixelColumns, 100.0f, l.image, work);
    l.depth_m = l.image.depth_m;
    fill(l.depth_m);
    locatePixels(l.scan, pixelDirections(sensor, static_cast<int>(l.depth_m.cols())), l.image,
                 l.depth_m, l.pixels);
    return l;
}

TEST(PixelPoints, PixelIsAtClosestReturn) {
    const SensorModel sensor = sensorModel("VLP-16");
    // Off the centre of its beam and column, like a real return.
    const Eigen::Vector3f near = test::onBeam(sensor, 3, 40.2, 6) + Eigen::Vector3f(0, 0, 0.02f);
    const Eigen::Vector3f far = test::onBeam(sensor, 3, 40.3, 9);
    for (const auto& points : {std::vector{far, near}, std::vector{near, far}}) {
        const Located l = located(sensor, points, [](Image<float>&) {});
        ASSERT_EQ(l.image.depth_mapper[0], l.image.depth_mapper[1]);
        EXPECT_EQ(l.pixels.at(l.image.depth_mapper[0]), near);
        EXPECT_EQ((!l.pixels.x_m.isNaN()).count(), 1);
        EXPECT_EQ((!l.pixels.y_m.isNaN()).count(), 1);
        EXPECT_EQ((!l.pixels.z_m.isNaN()).count(), 1);
    }
}

TEST(PixelPoints, RepairedPixelIsOnItsBeam) {
    const SensorModel sensor = sensorModel("VLP-16");
    const Located l = located(sensor, {}, [](Image<float>& depth_m) {
        depth_m(2, 7) = 5.0f;
        depth_m(15, 300) = 12.0f;
    });
    for (const auto& [row, column, depth_m] : {std::tuple{2, 7, 5.0f}, {15, 300, 12.0f}}) {
        const Eigen::Vector3f point_m = l.pixels.at(column * 16 + row);
        EXPECT_NEAR(point_m.norm(), depth_m, 1e-5);
        EXPECT_EQ(nearestColumn(std::atan2(point_m.y(), point_m.x()), kPixelColumns), column);
        EXPECT_NEAR(std::asin(point_m.z() / depth_m), sensor.elevations_rad[row], 1e-5);
    }
    EXPECT_EQ((!l.pixels.x_m.isNaN()).count(), 2);
}

TEST(PixelPoints, MovingKeepsDistances) {
    test::Random random(65);
    PixelPoints pixels;
    pixels.x_m = random.image(4, 9, -20, 20, 0.3);
    pixels.y_m = pixels.x_m.isNaN().select(kNoValue, random.image(4, 9, -20, 20, 0));
    pixels.z_m = pixels.x_m.isNaN().select(kNoValue, random.image(4, 9, -3, 3, 0));
    Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
    motion.rotate(Eigen::AngleAxisf(0.3f, Eigen::Vector3f(1, 2, -1).normalized()));
    motion.translation() = Eigen::Vector3f(1, -2, 3);
    PixelPoints moved = pixels;
    movePixels(motion, moved);
    for (int pixel = 0; pixel < 36; ++pixel) {
        ASSERT_EQ(hasValue(moved.z_m.data()[pixel]), hasValue(pixels.x_m.data()[pixel]));
        if (!hasValue(moved.z_m.data()[pixel])) continue;
        const Eigen::Vector3f expected =
            motion.rotation() * pixels.at(pixel) + Eigen::Vector3f(1, -2, 3);
        EXPECT_LT((moved.at(pixel) - expected).norm(), 1e-4f);
    }
}

}  // namespace
}  // namespace hagen
