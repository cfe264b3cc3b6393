#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>

#include <cmath>
#include <limits>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
ProjectionWorkspace work;  // reused, as in a filter

TEST(RangeImage, NearestColumnMatchesSearch) {
    test::Random random(3);
    for (const int columns : {8, 360, 870, 1800}) {
        for (int i = 0; i < 300; ++i) {
            const float azimuth_rad = random.real(-3.14159f, 3.14159f);
            const auto distance = [&](int column) {
                return std::abs(std::remainder(
                    static_cast<double>(columnAzimuth(column, columns) - azimuth_rad), 2 * kPi));
            };
            const int found = nearestColumn(azimuth_rad, columns);
            for (int column = 0; column < columns; ++column) {
                ASSERT_LE(distance(found), distance(column) + 1e-5);
            }
        }
    }
}

TEST(RangeImage, ForwardIsMiddleColumn) {
    EXPECT_NEAR(nearestColumn(0.0f, 870), 435, 1);
    EXPECT_NEAR(nearestColumn(static_cast<float>(kPi / 2), 870), 217, 1);
    EXPECT_NEAR(nearestColumn(static_cast<float>(-kPi / 2), 870), 652, 1);
}

/// Implements the definition return by return.
void projectPlainly(const Scan& scan, const SensorModel& sensor, int columns, float context_m,
                    RangeImage& image) {
    image.depth_m.setConstant(sensor.rows(), columns, kNoValue);
    image.closest_return.setConstant(sensor.rows(), columns, RangeImage::kNoReturn);
    image.depth_mapper.assign(scan.size(), RangeImage::kNoPixel);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float range_m = scan.range_m[i];
        if (!sensor.sees(range_m) || range_m > context_m) continue;
        const int column = nearestColumn(scan.azimuth_rad[i], columns);
        float& depth_m = image.depth_m(scan.row[i], column);
        if (!(depth_m <= range_m)) {  // empty pixel, or farther return
            depth_m = range_m;
            image.closest_return(scan.row[i], column) = static_cast<std::int32_t>(i);
        }
        image.depth_mapper[i] = column * sensor.rows() + scan.row[i];
    }
}

void expectSameImage(const RangeImage& a, const RangeImage& b) {
    EXPECT_TRUE(test::same(a.depth_m, b.depth_m));
    EXPECT_TRUE((a.closest_return == b.closest_return).all());
    EXPECT_EQ(a.depth_mapper, b.depth_mapper);
}

SensorModel sensorOfRows(int rows) {
    std::vector<double> elevations_deg(rows);
    for (int row = 0; row < rows; ++row) elevations_deg[row] = -30.0 + 40.0 * row / rows;
    return customSensorModel(elevations_deg);
}

/// Azimuths over the whole turn, including both ends, with many equal ranges and some NaN.
Scan scanWithTies(test::Random& random, int rows, int returns) {
    Scan scan;
    for (int i = 0; i < returns; ++i) {
        scan.row.push_back(static_cast<std::uint8_t>(random.whole(0, rows - 1)));
        const float end_rad = random.chance(0.5) ? 3.1415928f : -3.1415928f;
        scan.azimuth_rad.push_back(random.chance(0.1) ? end_rad : random.real(-3.14159f, 3.14159f));
        const float range_m = 0.25f * static_cast<float>(random.whole(0, 200));
        scan.range_m.push_back(random.chance(0.05)   ? kNoValue
                               : random.chance(0.05) ? kFar
                                                     : range_m);
        for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m}) values->push_back(0.0f);
    }
    return scan;
}

TEST(RangeImage, MatchesDefinition) {
    test::Random random(8);
    RangeImage plain, image;  // reused, as between scans
    for (int round = 0; round < 150; ++round) {
        const int rows = random.whole(2, 128);
        SensorModel sensor = sensorOfRows(rows);
        sensor.min_range_m = random.chance(0.5) ? 0.0f : 0.75f;
        const int columns = random.chance(0.1) ? 1 : random.whole(2, 1000);
        const int returns = random.chance(0.5) ? random.whole(0, 300) : random.whole(0, 20000);
        const Scan scan = scanWithTies(random, rows, returns);
        const float context_m = random.chance(0.5) ? kFar : 30.0f;
        projectPlainly(scan, sensor, columns, context_m, plain);
        projectScan(scan, sensor, columns, context_m, image, work);
        expectSameImage(image, plain);
    }
}

TEST(RangeImage, EmptyScanYieldsEmptyImage) {
    RangeImage image;
    projectScan(Scan(), sensorModel("VLP-16"), 870, kFar, image, work);
    EXPECT_EQ(image.depth_m.rows(), 16);
    EXPECT_EQ(image.depth_m.cols(), 870);
    EXPECT_TRUE(image.depth_m.isNaN().all());
    EXPECT_TRUE((image.closest_return == RangeImage::kNoReturn).all());
    EXPECT_TRUE(image.depth_mapper.empty());
}

}  // namespace
}  // namespace hagen
