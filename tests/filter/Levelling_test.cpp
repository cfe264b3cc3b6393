#include <gtest/gtest.h>
#include <hagen/filter/Levelling.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>
#include "filter/paper/RangeAngle.h"

#include <cmath>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

constexpr int kTiltedColumns = 90;

Attitude randomAttitude(test::Random& random) {
    const float max_rad = static_cast<float>(radians(15));
    return {random.real(-max_rad, max_rad), random.real(-max_rad, max_rad)};
}

Image<float> levelAngles(const Image<float>& depth_m, const SensorModel& sensor,
                         const std::optional<Attitude>& attitude) {
    Image<float> angles_rad;
    rangeAngles(depth_m, pixelDirections(sensor, static_cast<int>(depth_m.cols())), attitude,
                angles_rad);
    return angles_rad;
}

// MRPT rotates by yaw, pitch, roll: R = Rz(yaw) Ry(pitch) Rx(roll), written out for yaw 0.
TEST(Levelling, RotationIsPitchThenRoll) {
    test::Random random(60);
    for (int round = 0; round < 20; ++round) {
        const Attitude a{random.real(-1.5f, 1.5f), random.real(-1.5f, 1.5f)};
        const float cr = std::cos(a.roll_rad), sr = std::sin(a.roll_rad);
        const float cp = std::cos(a.pitch_rad), sp = std::sin(a.pitch_rad);
        Eigen::Matrix3f expected;
        expected << cp, sp * sr, sp * cr,  //
            0, cr, -sr,                    //
            -sp, cp * sr, cp * cr;
        EXPECT_LT((levelFromSensor(a) - expected).cwiseAbs().maxCoeff(), 1e-6f);
    }
}

TEST(Levelling, MatchesLevelCoordinates) {
    test::Random random(63);
    const SensorModel sensor = sensorModel("VLP-16");
    const Image<float> depth_m = random.image(16, kTiltedColumns, 1, 30, 0.2);
    const Attitude attitude = randomAttitude(random);
    const Image<float> angles_rad = levelAngles(depth_m, sensor, attitude);
    const Eigen::Matrix3d level = levelFromSensor(attitude).cast<double>();
    ASSERT_EQ(angles_rad.rows(), 15);
    for (int column = 0; column < kTiltedColumns; ++column) {
        const double azimuth_rad = static_cast<double>(columnAzimuth(column, kTiltedColumns));
        for (int row = 0; row < 15; ++row) {
            const float below = depth_m(row, column), above = depth_m(row + 1, column);
            ASSERT_EQ(hasValue(angles_rad(row, column)), hasValue(below) && hasValue(above));
            if (!hasValue(angles_rad(row, column))) continue;
            const auto at = [&](int r, float range_m) {
                return Eigen::Vector3d(
                    static_cast<double>(range_m) * level *
                    test::directionOf(azimuth_rad, static_cast<double>(sensor.elevations_rad[r])));
            };
            const Eigen::Vector3d step_m = at(row + 1, above) - at(row, below);
            EXPECT_NEAR(angles_rad(row, column),
                        std::atan2(std::abs(step_m.z()), std::hypot(step_m.x(), step_m.y())), 1e-4);
        }
    }
}

TEST(Levelling, WithoutTiltMatchesPaper) {
    test::Random random(64);
    const SensorModel sensor = sensorModel("VLP-16");
    const Image<float> depth_m = random.image(16, kTiltedColumns, 1, 30, 0.2);
    Image<float> papers_rad;
    rangeAngles(depth_m, pixelDirections(sensor, static_cast<int>(depth_m.cols())), papers_rad);
    EXPECT_TRUE(test::same(levelAngles(depth_m, sensor, std::nullopt), papers_rad));
    const Image<float> level_rad = levelAngles(depth_m, sensor, Attitude{});
    EXPECT_TRUE((level_rad.isNaN() == papers_rad.isNaN()).all());
    EXPECT_LT((level_rad.isNaN()).select(0.0f, (level_rad - papers_rad).abs()).maxCoeff(), 1e-5f);
}

}  // namespace
}  // namespace hagen
