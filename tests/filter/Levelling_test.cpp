#include <gtest/gtest.h>
#include <hagen/filter/Levelling.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>
#include "filter/paper/RangeAngle.h"

#include <cmath>

#include "support/InstructionSets.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

constexpr int kColumns = 90;

Attitude tilted(double roll_deg, double pitch_deg) {
    return {static_cast<float>(radians(roll_deg)), static_cast<float>(radians(pitch_deg))};
}

Attitude randomAttitude(test::Random& random) {
    return tilted(static_cast<double>(random.real(-15, 15)),
                  static_cast<double>(random.real(-15, 15)));
}

Image<float> levelAngles(const Image<float>& depth_m, const SensorModel& sensor,
                         const std::optional<Attitude>& attitude) {
    Image<float> angles_rad;
    rangeAngles(depth_m, pixelDirections(sensor, static_cast<int>(depth_m.cols())), attitude,
                angles_rad);
    return angles_rad;
}

/// Depths of the plane normal . p = offset_m, given in the level frame, for a tilted sensor at the
/// origin; NaN beyond `farthest_m`.
Image<float> depthsOfPlane(const SensorModel& sensor, const Attitude& attitude,
                           const Eigen::Vector3d& normal, double offset_m, double farthest_m) {
    const Eigen::Matrix3d level = levelFromSensor(attitude).cast<double>();
    Image<float> depth_m = Image<float>::Constant(sensor.rows(), kColumns, kNoValue);
    for (int column = 0; column < kColumns; ++column) {
        const double azimuth_rad = static_cast<double>(columnAzimuth(column, kColumns));
        for (int row = 0; row < sensor.rows(); ++row) {
            const double elevation_rad = static_cast<double>(sensor.elevations_rad[row]);
            const Eigen::Vector3d direction = level * test::directionOf(azimuth_rad, elevation_rad);
            const double range_m = offset_m / normal.dot(direction);
            if (range_m > 0 && range_m < farthest_m) {
                depth_m(row, column) = static_cast<float>(range_m);
            }
        }
    }
    return depth_m;
}

// MRPT rotates by yaw, pitch, roll: R = Rz(yaw) Ry(pitch) Rx(roll), multiplied out for yaw 0.
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

TEST(Levelling, LevelGroundHasZeroAngles) {
    test::Random random(61);
    const SensorModel sensor = sensorModel("HDL-32E");
    for (int round = 0; round < 20; ++round) {
        const Attitude attitude = randomAttitude(random);
        const Image<float> depth_m =
            depthsOfPlane(sensor, attitude, -Eigen::Vector3d::UnitZ(), 2.0, 50.0);
        const Image<float> angles_rad = levelAngles(depth_m, sensor, attitude);
        ASSERT_GT((!angles_rad.isNaN()).count(), 500);
        EXPECT_LT(angles_rad.isNaN().select(0.0f, angles_rad).maxCoeff(), 1e-3f);
    }
}

TEST(Levelling, WithoutAttitudeGroundSlopes) {
    const SensorModel sensor = sensorModel("HDL-32E");
    const Image<float> depth_m =
        depthsOfPlane(sensor, tilted(0, 10), -Eigen::Vector3d::UnitZ(), 2.0, 50.0);
    const Image<float> angles_rad = levelAngles(depth_m, sensor, std::nullopt);
    EXPECT_NEAR(degrees(static_cast<double>(angles_rad(0, kColumns / 2))), 10.0, 0.1);
}

TEST(Levelling, WallIsUprightForTiltedSensor) {
    test::Random random(62);
    const SensorModel sensor = sensorModel("VLP-16");
    for (int round = 0; round < 20; ++round) {
        const Attitude attitude = randomAttitude(random);
        // The beams of a firing lie in a plane that is not vertical for a tilted sensor; they hit
        // the wall perpendicularly only straight ahead of a sensor without roll.
        const Attitude nodding{0, attitude.pitch_rad};
        const Image<float> depth_m =
            depthsOfPlane(sensor, nodding, Eigen::Vector3d::UnitX(), 10.0, 50.0);
        const Image<float> angles_rad = levelAngles(depth_m, sensor, nodding);
        for (int row = 0; row < 15; ++row) {
            EXPECT_GT(degrees(static_cast<double>(angles_rad(row, kColumns / 2))), 89.0);
        }
    }
}

TEST(Levelling, MatchesLevelCoordinates) {
    test::Random random(63);
    const SensorModel sensor = sensorModel("VLP-16");
    const Image<float> depth_m = random.image(16, kColumns, 1, 30, 0.2);
    const Attitude attitude = randomAttitude(random);
    const Image<float> angles_rad = levelAngles(depth_m, sensor, attitude);
    const Eigen::Matrix3d level = levelFromSensor(attitude).cast<double>();
    ASSERT_EQ(angles_rad.rows(), 15);
    for (int column = 0; column < kColumns; ++column) {
        const double azimuth_rad = static_cast<double>(columnAzimuth(column, kColumns));
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
    const Image<float> depth_m = random.image(16, kColumns, 1, 30, 0.2);
    Image<float> papers_rad;
    rangeAngles(depth_m, pixelDirections(sensor, static_cast<int>(depth_m.cols())), papers_rad);
    EXPECT_TRUE(test::same(levelAngles(depth_m, sensor, std::nullopt), papers_rad));
    const Image<float> level_rad = levelAngles(depth_m, sensor, Attitude{});
    EXPECT_TRUE((level_rad.isNaN() == papers_rad.isNaN()).all());
    EXPECT_LT((level_rad.isNaN()).select(0.0f, (level_rad - papers_rad).abs()).maxCoeff(), 1e-5f);
}

TEST(Levelling, EmptyImageHasNoAngles) {
    const Image<float> empty = Image<float>::Constant(16, 8, kNoValue);
    EXPECT_TRUE(levelAngles(empty, sensorModel("VLP-16"), tilted(5, 5)).isNaN().all());
}

}  // namespace
}  // namespace hagen
