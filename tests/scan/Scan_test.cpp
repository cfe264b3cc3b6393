#include <gtest/gtest.h>
#include <hagen/scan/Scan.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

void addPoint(float x, float y, float z, Scan& scan) {
    scan.x_m.push_back(x);
    scan.y_m.push_back(y);
    scan.z_m.push_back(z);
    scan.intensity.push_back(0.0f);
}

/// Sensors with dense beams, and with beams that point straight up and down.
std::vector<SensorModel> allSensors() {
    std::vector<SensorModel> sensors;
    for (const std::string& name : knownSensorModels()) sensors.push_back(sensorModel(name));
    std::vector<double> crowded_deg;
    for (int beam = 0; beam < 256; ++beam) crowded_deg.push_back(-2.0 + 0.01 * beam);
    sensors.push_back(customSensorModel(crowded_deg));
    sensors.push_back(customSensorModel({-90.0, -45.0, 0.0, 0.125, 89.5, 90.0}));
    sensors.push_back(customSensorModel({3.0, 4.0}));
    return sensors;
}

/// Points all around; some are on axes, some not finite.
Scan pointsAround(test::Random& random, int count) {
    const float specials[] = {0.0f,   -0.0f, 1.0f,     -1.0f,
                              1e-30f, 1e30f, kNoValue, std::numeric_limits<float>::infinity()};
    const auto coordinate = [&](float max) {
        return random.chance(0.05) ? specials[random.whole(0, 7)] : random.real(-max, max);
    };
    Scan scan;
    for (int i = 0; i < count; ++i) {
        const float far_m = random.chance(0.2) ? 1.0f : 100.0f, x_m = coordinate(far_m),
                    y_m = coordinate(far_m);
        addPoint(x_m, y_m, coordinate(random.chance(0.2) ? 100.0f : 20.0f), scan);
    }
    return scan;
}

/// The paper's definition, point by point in double precision.
void expectBeamsOfDefinition(const SensorModel& sensor, const Scan& scan) {
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        const float range_m = std::sqrt(x * x + y * y + z * z);
        if (!std::isfinite(range_m) || range_m == 0.0f) {
            ASSERT_TRUE(std::isnan(scan.range_m[i]));
            ASSERT_EQ(scan.azimuth_rad[i], 0.0f);
            ASSERT_EQ(scan.row[i], 0);
            continue;
        }
        ASSERT_EQ(scan.range_m[i], range_m);
        const double azimuth_rad = std::atan2(static_cast<double>(y), static_cast<double>(x));
        ASSERT_NEAR(scan.azimuth_rad[i], azimuth_rad, 5e-7) << x << " " << y;
        // Rows may only differ if rounding moves the point across the midpoint angle.
        const double sine = static_cast<double>(z) / std::hypot(x, y, static_cast<double>(z));
        const double elevation_rad = std::asin(std::clamp(sine, -1.0, 1.0));
        const int row = scan.row[i],
                  expected = sensor.nearestRow(static_cast<float>(elevation_rad));
        ASSERT_LT(row, sensor.rows());
        if (row == expected) continue;
        ASSERT_EQ(std::abs(row - expected), 1);
        const double midpoint_rad = 0.5 * (static_cast<double>(sensor.elevations_rad[row]) +
                                           static_cast<double>(sensor.elevations_rad[expected]));
        ASSERT_NEAR(sine, std::sin(midpoint_rad), 2e-7);
    }
}

TEST(Scan, BeamsMatchDefinition) {
    test::Random random(10);
    for (const SensorModel& sensor : allSensors()) {
        SCOPED_TRACE(sensor.name + " of " + std::to_string(sensor.rows()));
        for (int count = 0; count < 40; ++count) {
            Scan scan = pointsAround(random, count);
            locateBeams(sensor, scan);
            expectBeamsOfDefinition(sensor, scan);
        }
        Scan scan = pointsAround(random, 20000);
        locateBeams(sensor, scan);
        expectBeamsOfDefinition(sensor, scan);
    }
}

TEST(Scan, TieGoesToLowerBeam) {
    Scan scan;
    addPoint(5, 0, 0, scan);  // midway between -1 and 1 degrees
    locateBeams(sensorModel("VLP-16"), scan);
    EXPECT_EQ(scan.row[0], 7);
}

}  // namespace
}  // namespace hagen
