#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/PixelDirections.h>
#include <cmath>

namespace hagen {
namespace {

TEST(PixelDirections, MatchBeamsAndColumnCentres) {
    const SensorModel sensor = sensorModel("VLP-16");
    const PixelDirections directions = pixelDirections(sensor, 8);
    ASSERT_EQ(directions.row_sine.size(), 16u);
    ASSERT_EQ(directions.row_cosine.size(), 16u);
    ASSERT_EQ(directions.column_sine.size(), 8u);
    ASSERT_EQ(directions.column_cosine.size(), 8u);
    EXPECT_NEAR(directions.row_sine[0], -std::sin(radians(15)), 1e-6);
    EXPECT_NEAR(directions.row_cosine[15], std::cos(radians(15)), 1e-6);
    // Column 0 points backwards, and columns are clockwise: of eight columns, the fourth and fifth
    // point ahead, the fourth half a column to the left.
    EXPECT_NEAR(directions.column_cosine[0], -std::cos(radians(22.5)), 1e-6);
    EXPECT_NEAR(directions.column_cosine[3], std::cos(radians(22.5)), 1e-6);
    EXPECT_NEAR(directions.column_sine[3], std::sin(radians(22.5)), 1e-6);
    EXPECT_NEAR(directions.column_sine[4], -std::sin(radians(22.5)), 1e-6);
}

}  // namespace
}  // namespace hagen
