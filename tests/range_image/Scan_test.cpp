#include <gtest/gtest.h>
#include <hagen/range_image/Angle.h>
#include <hagen/range_image/Scan.h>

#include <cmath>
#include <limits>

#include "support/Random.h"

namespace hagen {
namespace {

void addPoint(float x, float y, float z, Scan& scan) {
    scan.x_m.push_back(x);
    scan.y_m.push_back(y);
    scan.z_m.push_back(z);
    scan.intensity.push_back(0.0f);
}

TEST(Scan, LocatesPointsMadeFromKnownBeamsAndAzimuths) {
    test::Random random(2);
    const SensorModel sensor = sensorModel("VLP-16");
    Scan scan;
    std::vector<int> rows;
    std::vector<float> azimuths_rad, ranges_m;
    for (int i = 0; i < 1000; ++i) {
        rows.push_back(random.whole(0, 15));
        azimuths_rad.push_back(random.real(-3.1f, 3.1f));
        ranges_m.push_back(random.real(0.5f, 100.0f));
        const float elevation = sensor.elevations_rad[rows[i]];
        addPoint(ranges_m[i] * std::cos(elevation) * std::cos(azimuths_rad[i]),
                 ranges_m[i] * std::cos(elevation) * std::sin(azimuths_rad[i]),
                 ranges_m[i] * std::sin(elevation), scan);
    }
    locateBeams(sensor, scan);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        EXPECT_EQ(scan.row[i], rows[i]);
        EXPECT_NEAR(scan.azimuth_rad[i], azimuths_rad[i], 1e-5);
        EXPECT_NEAR(scan.range_m[i], ranges_m[i], 1e-4);
    }
}

TEST(Scan, PointsThatAreNowhereHaveNoRange) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Scan scan;
    addPoint(kNan, 1, 1, scan);
    addPoint(1, kInfinity, 1, scan);
    addPoint(1, 1, -kInfinity, scan);
    addPoint(0, 0, 0, scan);
    addPoint(1e30f, 0, 0, scan);  // its square is not finite
    locateBeams(sensorModel("VLP-16"), scan);
    for (const float range_m : scan.range_m) EXPECT_TRUE(std::isnan(range_m));
}

TEST(Scan, StraightUpAndDownGoToTheOutermostBeams) {
    Scan scan;
    addPoint(0, 0, 3, scan);
    addPoint(0, 0, -3, scan);
    locateBeams(sensorModel("VLP-16"), scan);
    EXPECT_EQ(scan.row[0], 15);
    EXPECT_EQ(scan.row[1], 0);
}

TEST(Scan, AnEmptyScanStaysEmpty) {
    Scan scan;
    locateBeams(sensorModel("VLP-16"), scan);
    EXPECT_EQ(scan.size(), 0u);
    EXPECT_TRUE(scan.range_m.empty());
}

TEST(Scan, ClearForgetsEverything) {
    Scan scan;
    addPoint(1, 2, 3, scan);
    locateBeams(sensorModel("VLP-16"), scan);
    scan.time_s.push_back(0.0f);
    scan.clear();
    EXPECT_TRUE(scan.x_m.empty() && scan.y_m.empty() && scan.z_m.empty() && scan.row.empty() &&
                scan.range_m.empty() && scan.azimuth_rad.empty() && scan.intensity.empty() &&
                scan.time_s.empty());
}

}  // namespace
}  // namespace hagen
