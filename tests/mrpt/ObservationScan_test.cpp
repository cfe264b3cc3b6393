#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservationComment.h>
#include "mrpt/Results.h"

#include <stdexcept>

#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

using mrpt::obs::CObservationPointCloud;

mrpt::obs::CObservationVelodyneScan::Ptr velodyneScan() {
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    return encodeScan(model, test::fireAt({}, model, {0, 0, 2}));
}

CObservationPointCloud::Ptr cloud(std::initializer_list<std::array<float, 4>> points) {
    Scan scan;
    for (const auto& [x, y, z, intensity] : points) {
        scan.x_m.push_back(x);
        scan.y_m.push_back(y);
        scan.z_m.push_back(z);
        scan.intensity.push_back(intensity);
    }
    return observationOf(scan, "lidar", mrpt::Clock::fromDouble(12.5));
}

TEST(ObservationScan, AcceptsLidarObservations) {
    EXPECT_TRUE(isLidarScan(*velodyneScan()));
    EXPECT_TRUE(isLidarScan(*cloud({})));
    EXPECT_FALSE(isLidarScan(mrpt::obs::CObservationComment()));
    const auto observation = cloud({});
    for (const bool is_roi : {true, false}) {
        EXPECT_FALSE(isLidarScan(*resultOf(*observation, is_roi, observation->pointcloud)));
    }
}

TEST(ObservationScan, AcceptsResultLikeLabels) {
    const auto observation = cloud({});
    for (const char* label : {"lidar_roi", "lidar_non_roi", "_roi", "", "roi", "droi"}) {
        observation->sensorLabel = label;
        EXPECT_TRUE(isLidarScan(*observation)) << label;
    }
}

TEST(ObservationScan, PacketsOverrideSettings) {
    ObservedScan observed;
    Settings settings;
    readObservation(*velodyneScan(), settings, observed);
    EXPECT_EQ(observed.sensor.name, "HDL-32E");
    EXPECT_EQ(observed.remark, "");
    settings.sensor.model = "VLP-16";
    readObservation(*velodyneScan(), settings, observed);
    EXPECT_EQ(observed.sensor.rows(), 32);
    EXPECT_THAT(observed.remark, HasSubstr("VLP-16"));
}

TEST(ObservationScan, ReadsCloudsInOrder) {
    ObservedScan observed;
    Settings settings;
    settings.sensor.model = "HDL-64E";
    readObservation(*cloud({{3, 0, 0, 0.25f}, {0, 4, 0, 0.5f}, {kNoValue, 1, 1, 1}}), settings,
                    observed);
    EXPECT_EQ(observed.sensor.rows(), 64);
    ASSERT_EQ(observed.scan.size(), 3u);
    EXPECT_EQ(observed.scan.range_m[0], 3.0f);
    EXPECT_EQ(observed.scan.range_m[1], 4.0f);
    EXPECT_FALSE(hasValue(observed.scan.range_m[2]));
    EXPECT_EQ(observed.scan.intensity, (std::vector<float>{0.25f, 0.5f, 1.0f}));
}

TEST(ObservationScan, FollowsChangedSettings) {
    ObservedScan observed;
    Settings settings;
    const auto rowsWith = [&](const Settings& with) {
        readObservation(*cloud({{3, 0, 0, 0}}), with, observed);
        return observed.sensor.rows();
    };
    EXPECT_EQ(rowsWith(settings), 16);
    EXPECT_TRUE(observed.is_sensor_assumed);
    settings.sensor.model = "HDL-64E";
    EXPECT_EQ(rowsWith(settings), 64);
    settings.sensor.max_range_m = 10.0f;
    rowsWith(settings);
    EXPECT_EQ(observed.sensor.max_range_m, 10.0f);
    EXPECT_FALSE(observed.is_sensor_assumed);
    settings.sensor.model = "custom";
    EXPECT_THROW(rowsWith(settings), SettingsError);
    settings.sensor.elevations_deg = {-5, 0, 5};
    EXPECT_EQ(rowsWith(settings), 3);
    settings.sensor.elevations_deg = {-5, 5};
    EXPECT_EQ(rowsWith(settings), 2);
    EXPECT_EQ(rowsWith(Settings()), 16);
}

TEST(ObservationScan, UsesRecoveredBeamsForUnnamedSensors) {
    RecoveredBeams recovered{customSensorModel({-5, 0, 5}), 1.0f, {}, 300, {}, false};
    const auto beams = std::make_shared<const RecoveredBeams>(recovered);
    ObservedScan observed;
    const auto rowsWith = [&](const Settings& settings, const SharedBeams& with) {
        readObservation(*cloud({{3, 0, 0.3f, 0}}), settings, observed, with);
        return observed.sensor.rows();
    };
    EXPECT_EQ(rowsWith({}, nullptr), 16);
    EXPECT_EQ(observed.recovered, nullptr);
    EXPECT_EQ(rowsWith({}, beams), 3);
    EXPECT_EQ(observed.scan.row[0], 2);
    EXPECT_EQ(observed.recovered, beams);
    EXPECT_FALSE(observed.is_sensor_assumed);
    Settings settings;
    settings.sensor.model = "HDL-64E";
    EXPECT_EQ(rowsWith(settings, beams), 64);
    EXPECT_EQ(observed.recovered, nullptr);
    settings.sensor.model.reset();
    settings.sensor.max_range_m = 2.0f;
    EXPECT_EQ(rowsWith(settings, beams), 3);
    EXPECT_EQ(observed.sensor.max_range_m, 2.0f);
    recovered.sensor = customSensorModel({-5, 5});
    EXPECT_EQ(rowsWith(settings, std::make_shared<const RecoveredBeams>(recovered)), 2);
    readObservation(*velodyneScan(), settings, observed, beams);  // packets specify their sensor
    EXPECT_EQ(observed.sensor.name, "HDL-32E");
    EXPECT_EQ(observed.recovered, nullptr);
}

TEST(ObservationScan, ScalesIntensitiesTo255) {
    ObservedScan observed;
    readObservation(*cloud({{3, 0, 0, 51.0f}, {0, 4, 0, 255.0f}}), Settings(), observed);
    EXPECT_EQ(observed.scan.intensity, (std::vector<float>{0.2f, 1.0f}));
    EXPECT_TRUE(observed.is_sensor_assumed);
}

TEST(ObservationScan, SettingsOverrideRangeLimits) {
    ObservedScan observed;
    Settings settings;
    settings.sensor.max_range_m = 10.0f;
    settings.sensor.min_range_m = 0.1f;
    readObservation(*velodyneScan(), settings, observed);
    EXPECT_EQ(observed.sensor.max_range_m, 10.0f);
    EXPECT_EQ(observed.sensor.min_range_m, 0.1f);
    readObservation(*velodyneScan(), Settings(), observed);
    EXPECT_EQ(observed.sensor.min_range_m, 0.5f);  // from the recording
    EXPECT_FALSE(observed.is_sensor_assumed);
}

TEST(ObservationScan, ReadsStoredVelodyneCloud) {
    mrpt::obs::CObservationVelodyneScan observation;
    observation.point_cloud.x = {1, 2};
    observation.point_cloud.y = {0, 0};
    observation.point_cloud.z = {0, 0};
    observation.point_cloud.intensity = {255, 0};
    ObservedScan observed;
    readObservation(observation, Settings(), observed);
    EXPECT_EQ(observed.scan.range_m, (std::vector<float>{1, 2}));
    EXPECT_EQ(observed.scan.intensity, (std::vector<float>{1, 0}));
    EXPECT_EQ(observed.remark, "");
    observation.point_cloud.intensity.push_back(7);
    EXPECT_THROW(readObservation(observation, Settings(), observed), std::runtime_error);
}

TEST(ObservationScan, ReportsEmptyScans) {
    ObservedScan observed;
    readObservation(mrpt::obs::CObservationVelodyneScan(), Settings(), observed);
    EXPECT_EQ(observed.scan.size(), 0u);
    EXPECT_THAT(observed.remark, HasSubstr("no packets"));
}

TEST(ObservationScan, RejectsUnreadableObservations) {
    ObservedScan observed;
    EXPECT_THROW(readObservation(CObservationPointCloud(), Settings(), observed),
                 std::runtime_error);
    EXPECT_THROW(readObservation(mrpt::obs::CObservationComment(), Settings(), observed),
                 std::runtime_error);
}

TEST(ObservationScan, ConvertsChosenReturnsToClouds) {
    Scan scan;
    scan.x_m = {1, 2, 3};
    scan.y_m = {4, 5, 6};
    scan.z_m = {7, 8, 9};
    scan.intensity = {0.25f, 0.5f, 0.75f};
    const auto simple = cloudOf(scan, {0, 2}, CloudClass::Simple);
    EXPECT_NE(std::dynamic_pointer_cast<PortableCloud>(simple), nullptr);
    EXPECT_EQ(simple->getPointsBufferRef_z(), (mrpt::aligned_std_vector<float>{7, 9}));
    const auto full =
        std::dynamic_pointer_cast<IntensityCloud>(cloudOf(scan, {0, 2}, CloudClass::WithIntensity));
    ASSERT_NE(full, nullptr);
    EXPECT_EQ(full->getPointsBufferRef_x(), (mrpt::aligned_std_vector<float>{1, 3}));
    EXPECT_EQ((*intensitiesOf(*full))[1], 0.75f);
    EXPECT_EQ(cloudOf(scan, CloudClass::Simple)->size(), 3u);
}

}  // namespace
}  // namespace hagen::observations
