#include <gmock/gmock.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/SensorModel.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "support/Random.h"

namespace hagen {
namespace {

using testing::HasSubstr;

TEST(SensorModel, KnownSensorsMatchDataSheets) {
    struct DataSheet {
        std::string name;
        int beams;
        double lowest_deg, highest_deg;
    };
    const std::vector<DataSheet> sensors{
        {"VLP-16", 16, -15, 15},      {"HDL-32E", 32, -30.67, 10.67}, {"HDL-64E", 64, -24.33, 2},
        {"Puck Hi-Res", 16, -10, 10}, {"VLP-32C", 32, -25, 15},       {"VLS-128", 128, -25, 15},
        {"XT32", 32, -16, 15},        {"XT16", 16, -15, 15},          {"OS0-128", 128, -45, 45},
        {"OS1-64", 64, -21.2, 21.2},  {"Mid-360", 24, -6.5, 51},      {"Avia", 40, -37.635, 37.635},
        {"HAP", 16, -11.719, 11.719}};
    const std::set<std::string> without_rings{"Mid-360", "Avia", "HAP"};
    ASSERT_EQ(knownSensorModels().size(), sensors.size());
    for (const auto& [name, count, lowest_deg, highest_deg] : sensors) {
        const SensorModel sensor = sensorModel(name);
        EXPECT_EQ(sensor.name, name);
        EXPECT_EQ(sensor.rows(), count);
        EXPECT_NEAR(degrees(sensor.elevations_rad.front()), lowest_deg, 0.01) << name;
        EXPECT_NEAR(degrees(sensor.elevations_rad.back()), highest_deg, 0.01) << name;
        EXPECT_EQ(sensor.has_rings, without_rings.count(name) == 0) << name;
        EXPECT_LT(sensor.min_range_m, sensor.max_range_m);
        EXPECT_TRUE(std::is_sorted(sensor.elevations_rad.begin(), sensor.elevations_rad.end()));
    }
}

TEST(SensorModel, VirtualBeamsAreEven) {
    const SensorModel sensor = sensorModel("Mid-360");
    EXPECT_FALSE(sensor.has_rings);
    EXPECT_EQ(sensor.min_range_m, 0.1f);
    EXPECT_EQ(sensor.max_range_m, 70.0f);
    for (int row = 0; row < sensor.rows(); ++row) {
        EXPECT_NEAR(degrees(sensor.elevations_rad[row]), -6.5 + 2.5 * row, 1e-5);
    }
    for (double elevation_deg = -7; elevation_deg <= 52; elevation_deg += 0.01) {
        const auto elevation_rad = static_cast<float>(radians(elevation_deg));
        const float beam_rad = sensor.elevations_rad[sensor.nearestRow(elevation_rad)];
        ASSERT_LE(std::abs(degrees(beam_rad - elevation_rad)), 1.2501) << elevation_deg;
    }
}

TEST(SensorModel, NearestRowMatchesSearch) {
    test::Random random(1);
    for (const std::string& name : knownSensorModels()) {
        const SensorModel sensor = sensorModel(name);
        for (int i = 0; i < 2000; ++i) {
            const float elevation_rad = random.real(-1.0f, 1.0f);
            int nearest = 0;
            for (int row = 1; row < sensor.rows(); ++row) {
                if (std::abs(sensor.elevations_rad[row] - elevation_rad) <
                    std::abs(sensor.elevations_rad[nearest] - elevation_rad)) {
                    nearest = row;
                }
            }
            ASSERT_EQ(sensor.nearestRow(elevation_rad), nearest) << name << " " << elevation_rad;
        }
    }
}

TEST(SensorModel, RejectsUnknownName) {
    EXPECT_THAT([] { sensorModel("VLP-61"); },
                testing::ThrowsMessage<std::invalid_argument>(
                    testing::AllOf(HasSubstr("VLP-61"), HasSubstr("HDL-32E"))));
}

TEST(SensorModel, CustomBeamsMustAscend) {
    EXPECT_EQ(customSensorModel({-10, 0, 5}).rows(), 3);
    EXPECT_THROW(customSensorModel({}), std::invalid_argument);
    EXPECT_THROW(customSensorModel({1}), std::invalid_argument);
    EXPECT_THROW(customSensorModel({0, 0}), std::invalid_argument);
    EXPECT_THROW(customSensorModel({5, -5}), std::invalid_argument);
    EXPECT_THROW(customSensorModel({0, 91}), std::invalid_argument);
    EXPECT_THROW(customSensorModel({0, NAN}), std::invalid_argument);
    EXPECT_THROW(customSensorModel(std::vector<double>(257, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace hagen
