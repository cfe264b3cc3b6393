#include <gtest/gtest.h>
#include <hagen/scan/Airframe.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen {
namespace {

const SensorModel kSensor = sensorModel("VLP-16");
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Eigen::Vector3f randomPoint(test::Random& random, float max_m) {
    return {random.real(-max_m, max_m), random.real(-max_m, max_m), random.real(-max_m, max_m)};
}

Airframe randomAirframe(test::Random& random) {
    Airframe airframe;
    for (int i = random.whole(0, 3); i > 0; --i) {
        const Eigen::Vector3f a = randomPoint(random, 1), b = randomPoint(random, 1);
        airframe.boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
    }
    for (int i = random.whole(0, 3); i > 0; --i) {
        airframe.spheres.push_back({randomPoint(random, 1), random.real(0.05f, 0.5f)});
    }
    if (random.chance(0.5)) {
        const int rows = 6 * random.whole(1, 15);
        airframe.bin_range_m = random.image(rows, 2 * rows, 0, 1.5f, 0.7);
        for (float& range_m : airframe.bin_range_m.reshaped()) {
            if (!hasValue(range_m)) range_m = 0;
        }
    }
    return airframe;
}

/// The definition in double precision and degrees.
bool isMasked(const Airframe& airframe, double x, double y, double z, double range_m) {
    for (const AirframeBox& box : airframe.boxes) {
        if (x >= box.low_m.x() && x <= box.high_m.x() && y >= box.low_m.y() &&
            y <= box.high_m.y() && z >= box.low_m.z() && z <= box.high_m.z())
            return true;
    }
    for (const AirframeSphere& sphere : airframe.spheres) {
        const double dx = x - sphere.centre_m.x(), dy = y - sphere.centre_m.y(),
                     dz = z - sphere.centre_m.z();
        if (std::sqrt(dx * dx + dy * dy + dz * dz) <= sphere.radius_m) return true;
    }
    const auto rows = airframe.bin_range_m.rows();
    if (rows == 0) return false;
    const double bin_deg = 180.0 / static_cast<double>(rows);
    const double length_m = std::sqrt(x * x + y * y + z * z);
    const auto row = static_cast<Eigen::Index>((degrees(std::asin(z / length_m)) + 90) / bin_deg);
    const auto column = static_cast<Eigen::Index>((degrees(std::atan2(y, x)) + 180) / bin_deg);
    return range_m <= airframe.bin_range_m(std::min(row, rows - 1), std::min(column, 2 * rows - 1));
}

TEST(Airframe, MasksBoxesSpheresAndBins) {
    test::Random random(11);
    std::size_t all_masked = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Airframe airframe = randomAirframe(random);
        std::vector<Eigen::Vector3f> points_m;
        for (int i = 0; i < 500; ++i) points_m.push_back(randomPoint(random, 1.5f));
        const Scan before = test::scanOf(kSensor, points_m);
        Scan scan = before;
        const std::size_t masked = maskAirframe(airframe, scan);
        std::size_t expected = 0;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const bool is_masked =
                isMasked(airframe, before.x_m[i], before.y_m[i], before.z_m[i], before.range_m[i]);
            expected += is_masked;
            ASSERT_EQ(std::isnan(scan.range_m[i]), is_masked) << "trial " << trial;
            if (is_masked) continue;
            ASSERT_EQ(scan.range_m[i], before.range_m[i]);
        }
        EXPECT_EQ(masked, expected);
        EXPECT_EQ(scan.x_m, before.x_m);
        EXPECT_EQ(scan.row, before.row);
        all_masked += masked;
    }
    EXPECT_GT(all_masked, 400u);
}

TEST(Airframe, MasksBorders) {
    Airframe airframe;
    airframe.boxes.push_back({{0, 0, 0}, {1, 1, 1}});
    airframe.spheres.push_back({{-2, 0, 0}, 1});
    Scan scan = test::scanOf(
        kSensor, {{1, 1, 1}, {1, 1, 1.0001f}, {-3, 0, 0}, {-3.0001f, 0, 0}, {-1, 0, 0}});
    EXPECT_EQ(maskAirframe(airframe, scan), 3u);
    EXPECT_EQ(hasValue(scan.range_m[1]) + hasValue(scan.range_m[3]), 2);
}

TEST(Airframe, BinsMeetAtPolesAndSeam) {
    EXPECT_EQ(airframeBinOf({0, 0, 1}, 90).row, 89);
    EXPECT_EQ(airframeBinOf({0, 0, -1}, 90).row, 0);
    EXPECT_EQ(airframeBinOf({-1, 0.0f, 0}, 90).column, 179);
    EXPECT_EQ(airframeBinOf({-1, -0.0f, 0}, 90).column, 0);
    EXPECT_EQ(airframeBinOf({1, 0.001f, 0.001f}, 90).column, 90);
    EXPECT_EQ(airframeBinOf({1, 0.001f, 0.001f}, 90).row, 45);
}

TEST(Airframe, IgnoresReturnsWithoutRange) {
    Airframe airframe;
    airframe.spheres.push_back({{0, 0, 0}, 2});
    airframe.bin_range_m = Image<float>::Constant(90, 180, 2.0f);
    Scan scan =
        test::scanOf(kSensor, {{0, 0, 0}, {kNoValue, 0, 1}, {kInfinity, 0, 0}, {0.5f, 0, 0}});
    EXPECT_EQ(maskAirframe(airframe, scan), 1u);
    for (const float range_m : scan.range_m) EXPECT_TRUE(std::isnan(range_m));
}

}  // namespace
}  // namespace hagen
