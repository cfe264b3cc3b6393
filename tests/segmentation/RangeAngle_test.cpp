#include <gtest/gtest.h>
#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/RangeAngle.h>

#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

Image<float> anglesOf(const Image<float>& depth_m, const SensorModel& sensor) {
    Image<float> angles_rad;
    rangeAngles(depth_m, pixelDirections(sensor, static_cast<int>(depth_m.cols())), angles_rad);
    return angles_rad;
}

TEST(RangeAngle, LevelGroundIsZero) {
    const SensorModel sensor = sensorModel("VLP-16");
    Image<float> depth_m = Image<float>::Constant(16, 3, kNoValue);
    for (int row = 0; row < 8; ++row)
        depth_m.row(row) = -2.0f / std::sin(sensor.elevations_rad[row]);
    const Image<float> angles_rad = anglesOf(depth_m, sensor);
    for (int row = 0; row < 7; ++row) EXPECT_NEAR(angles_rad(row, 0), 0.0f, 1e-4f);
    for (int row = 7; row < 15; ++row) EXPECT_FALSE(hasValue(angles_rad(row, 0)));
}

TEST(RangeAngle, AWallIsNinetyDegrees) {
    const SensorModel sensor = sensorModel("HDL-32E");
    Image<float> depth_m(32, 2);
    for (int row = 0; row < 32; ++row)
        depth_m.row(row) = 10.0f / std::cos(sensor.elevations_rad[row]);
    EXPECT_LT((anglesOf(depth_m, sensor) - static_cast<float>(kPi / 2)).abs().maxCoeff(), 1e-4f);
}

TEST(RangeAngle, ASlopeHasItsOwnAngle) {
    // Points (x, z) with z = (x - 20) tan(30 deg), seen from the origin.
    const SensorModel sensor = sensorModel("VLP-16");
    const double slope = std::tan(radians(30));
    Image<float> depth_m(16, 1);
    for (int row = 0; row < 16; ++row) {
        const double elevation = static_cast<double>(sensor.elevations_rad[row]);
        depth_m(row, 0) =
            static_cast<float>(20 * slope / (slope * std::cos(elevation) - std::sin(elevation)));
    }
    const Image<float> angles_rad = anglesOf(depth_m, sensor);
    for (int row = 0; row < 15; ++row) EXPECT_NEAR(degrees(angles_rad(row, 0)), 30.0, 0.01);
}

TEST(RangeAngle, LiesBetweenZeroAndNinetyDegreesAndIsEmptyNextToEmptyPixels) {
    test::Random random(12);
    const SensorModel sensor = sensorModel("HDL-64E");
    const Image<float> depth_m = random.image(64, 40, 0.5f, 100.0f, 0.2);
    const Image<float> angles_rad = anglesOf(depth_m, sensor);
    ASSERT_EQ(angles_rad.rows(), 63);
    for (int column = 0; column < 40; ++column) {
        for (int row = 0; row < 63; ++row) {
            const bool both = hasValue(depth_m(row, column)) && hasValue(depth_m(row + 1, column));
            ASSERT_EQ(hasValue(angles_rad(row, column)), both);
            if (!both) continue;
            ASSERT_GE(angles_rad(row, column), 0.0f);
            ASSERT_LE(angles_rad(row, column), static_cast<float>(kPi / 2) + 1e-6f);
        }
    }
}

TEST(CarryAngles, ThatWithTheBeamAboveElseThatWithTheBeamBelow) {
    Image<float> range_angle_rad(4, 1), carried_rad, expected(5, 1);
    range_angle_rad << 0.1f, 0.2f, kNoValue, kNoValue;
    expected << 0.1f, 0.2f, 0.2f, kNoValue, kNoValue;
    carryAngles(range_angle_rad, carried_rad);
    EXPECT_TRUE(test::same(carried_rad, expected));
}

TEST(CarryAngles, TheTopRowCarriesTheAngleBelow) {
    Image<float> range_angle_rad(2, 1), carried_rad, expected(3, 1);
    range_angle_rad << kNoValue, 0.7f;
    expected << kNoValue, 0.7f, 0.7f;
    carryAngles(range_angle_rad, carried_rad);
    EXPECT_TRUE(test::same(carried_rad, expected));
}

}  // namespace
}  // namespace hagen
