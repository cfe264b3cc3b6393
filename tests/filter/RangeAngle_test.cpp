#include "filter/paper/RangeAngle.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

/// Implements the definition pixel by pixel.
Image<float> plainAngles(const Image<float>& depth_m, const PixelDirections& directions) {
    Image<float> angles_rad(depth_m.rows() - 1, depth_m.cols());
    for (int column = 0; column < depth_m.cols(); ++column) {
        for (int row = 0; row + 1 < depth_m.rows(); ++row) {
            const float below = depth_m(row, column), above = depth_m(row + 1, column);
            const float dz =
                above * directions.row_sine[row + 1] - below * directions.row_sine[row];
            const float dx =
                above * directions.row_cosine[row + 1] - below * directions.row_cosine[row];
            angles_rad(row, column) = std::atan2(std::abs(dz), std::abs(dx));
        }
    }
    return angles_rad;
}

Image<float> plainCarried(const Image<float>& range_angle_rad, bool to_beam_above = true) {
    const Eigen::Index rows = range_angle_rad.rows() + 1;
    Image<float> carried_rad(rows, range_angle_rad.cols());
    for (int column = 0; column < range_angle_rad.cols(); ++column) {
        for (int row = 0; row < rows; ++row) {
            const float with_above = row + 1 < rows ? range_angle_rad(row, column) : kNoValue;
            const float with_below = row > 0 ? range_angle_rad(row - 1, column) : kNoValue;
            const float first = to_beam_above ? with_above : with_below;
            const float second = to_beam_above ? with_below : with_above;
            carried_rad(row, column) = hasValue(first) ? first : second;
        }
    }
    return carried_rad;
}

/// A sensor with `rows` beams from -25 to 15 degrees.
PixelDirections directionsOf(int rows, int columns) {
    SensorModel sensor;
    for (int row = 0; row < rows; ++row) {
        sensor.elevations_rad.push_back(static_cast<float>(radians(-25 + 40.0 * row / rows)));
    }
    return pixelDirections(sensor, columns);
}

const std::pair<int, int> kSizes[] = {{2, 1},   {3, 7},  {8, 5},   {9, 31},  {16, 1},
                                      {16, 87}, {17, 2}, {32, 13}, {64, 29}, {128, 9}};

TEST(RangeAngle, MatchesArctangent) {
    test::Random random(11);
    for (const auto& [rows, columns] : kSizes) {
        const PixelDirections directions = directionsOf(rows, columns);
        for (const double missing : {0.0, 0.3, 1.0}) {
            Image<float> depth_m = random.image(rows, columns, 0.5f, 30.0f, missing);
            if (random.chance(0.5)) depth_m = (depth_m * 4).round() / 4;  // equal neighbours
            const Image<float> expected = plainAngles(depth_m, directions);
            Image<float> found = Image<float>::Constant(3, 3, 7.0f);
            rangeAngles(depth_m, directions, found);
            ASSERT_TRUE((found.isNaN() == expected.isNaN()).all());
            ASSERT_LE(expected.isNaN().select(0.0f, (found - expected).abs()).maxCoeff(), 1e-6f);
        }
    }
}

TEST(RangeAngle, HandlesExactAnglesAndZeroSteps) {
    const PixelDirections directions{{0.5f, 0.5f, 1.0f, 0.0f}, {0.5f, 1.0f, 1.0f, 0.0f}, {0}, {1}};
    Image<float> found;
    rangeAngles(Image<float>::Constant(4, 1, 3.0f), directions, found);
    EXPECT_EQ(found(0, 0), 0.0f);
    EXPECT_EQ(found(1, 0), static_cast<float>(kPi / 2));
    EXPECT_NEAR(found(2, 0), kPi / 4, 1e-6);
    rangeAngles(Image<float>::Zero(4, 1), directions, found);
    EXPECT_TRUE((found == 0.0f).all());
}

TEST(RangeAngle, IsSameOnEveryInstructionSet) {
    test::Random random(10);
    for (const auto& [rows, columns] : kSizes) {
        const PixelDirections directions = directionsOf(rows, columns);
        const Image<float> depth_m = random.image(rows, columns, 0.5f, 30.0f, 0.2);
        Image<float> expected, carried;
        rangeAngles(depth_m, directions, expected);
        forEachInstructionSet([&, rows = rows](const std::string& name) {
            Image<float> found;
            rangeAngles(depth_m, directions, found);
            EXPECT_TRUE(test::same(found, expected)) << name << ", rows " << rows;
            for (const bool to_beam_above : {true, false}) {
                carryAngles(expected, carried, to_beam_above);
                EXPECT_TRUE(test::same(carried, plainCarried(expected, to_beam_above)))
                    << name << ", rows " << rows;
            }
        });
    }
}

TEST(LevelGaps, GapsBecomeZero) {
    Image<float> range_angle_rad(2, 3), expected(2, 3);
    range_angle_rad << 0.1f, kNoValue, 0.3f, kNoValue, 0.5f, 0.0f;
    expected << 0.1f, 0.0f, 0.3f, 0.0f, 0.5f, 0.0f;
    levelGaps(range_angle_rad);
    EXPECT_TRUE(test::same(range_angle_rad, expected));
}

}  // namespace
}  // namespace hagen
