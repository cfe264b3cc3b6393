#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <chrono>
#include <stdexcept>

#include "support/Captures.h"
#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

using mrpt::obs::CObservationVelodyneScan;

CObservationVelodyneScan::Ptr scanFrom(double x_m, const char* label = "front") {
    auto scan = test::poleScanFrom(x_m, label);
    scan->sensorPose = mrpt::poses::CPose3D(0.1, 0, -0.2, 0.3, 0, 0);
    return scan;
}

/// A vehicle that stands still, between two times in seconds after the scans' time.
Trajectory standingAt(const mrpt::poses::CPose3D& pose, double from_s, double to_s) {
    Trajectory vehicle;
    for (double s = from_s; s <= to_s; s += 0.1) {
        vehicle.add(mrpt::Clock::fromDouble(100.0 + s), pose);
    }
    return vehicle;
}

TEST(ObservationSegmenter, IsCreatedByName) {
    registerHagenClasses();
    for (const char* name :
         {"hagen::observations::ObservationSegmenter", "hagen::ObservationSegmenter"}) {
        const auto object = mrpt::rtti::classFactory(name);
        ASSERT_NE(object, nullptr) << name;
        const auto segmenter = std::dynamic_pointer_cast<ObservationSegmenter>(object);
        ASSERT_NE(segmenter, nullptr) << name;
        ObservationSegmenter::Output out;
        EXPECT_TRUE(segmenter->process(*scanFrom(0), out));
        EXPECT_EQ(std::string(segmenter->GetRuntimeClass()->className),
                  "hagen::observations::ObservationSegmenter");
    }
}

TEST(ObservationSegmenter, IgnoresOtherObservations) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    EXPECT_FALSE(segmenter.process(mrpt::obs::CObservationComment(), out));
    EXPECT_EQ(out.roi, nullptr);
    ASSERT_TRUE(segmenter.process(*scanFrom(0), out));
    const auto non_roi = out.non_roi;
    EXPECT_FALSE(segmenter.process(*non_roi, out));
}

TEST(ObservationSegmenter, CloudsKeepTimePoseAndLabel) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    const auto scan = scanFrom(0);
    ASSERT_TRUE(segmenter.process(*scan, out));
    for (const auto& [cloud, label] :
         {std::pair{out.roi, "front_roi"}, {out.non_roi, "front_non_roi"}}) {
        EXPECT_EQ(cloud->sensorLabel, label);
        EXPECT_EQ(cloud->timestamp, scan->timestamp);
        EXPECT_EQ(cloud->sensorPose, scan->sensorPose);
        EXPECT_NE(std::dynamic_pointer_cast<PortableCloud>(cloud->pointcloud), nullptr);
    }
}

TEST(ObservationSegmenter, SplitsReturnsInOrder) {
    const auto scan = test::realVlp16Scan();
    if (!scan) GTEST_SKIP() << "mrpt-common is not installed";
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    ASSERT_TRUE(segmenter.process(*scan, out));
    EXPECT_EQ(out.roi->pointcloud->size() + out.non_roi->pointcloud->size(), 22591u);
    Scan decoded;
    decodePackets(*scan, decoded);
    std::size_t next_roi = 0, next_rou = 0;
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        const bool is_roi = out.result->returns.label[i] == Label::Roi;
        const auto& cloud = is_roi ? *out.roi->pointcloud : *out.non_roi->pointcloud;
        const std::size_t at = is_roi ? next_roi++ : next_rou++;
        ASSERT_EQ(cloud.getPointsBufferRef_x()[at], decoded.x_m[i]);
        ASSERT_EQ(cloud.getPointsBufferRef_z()[at], decoded.z_m[i]);
    }
}

TEST(ObservationSegmenter, IsReproducible) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    const auto labels = out.result->returns.label;
    segmenter.process(*scanFrom(3), out);
    segmenter.process(*scanFrom(0), out);
    EXPECT_EQ(out.result->returns.label, labels);
}

TEST(ObservationSegmenter, UsesOneFilterPerLabel) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output front, rear, again;
    segmenter.process(*scanFrom(0, "front"), front);
    segmenter.process(*scanFrom(0, "rear"), rear);
    segmenter.process(*scanFrom(0, "front"), again);
    EXPECT_NE(rear.result, front.result);
    EXPECT_EQ(again.result, front.result);
}

TEST(ObservationSegmenter, ReportsSensorPose) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    const mrpt::poses::CPose3D vehicle(1, 2, 3, 0.5, 0.1, 0);
    segmenter.process(*scanFrom(0), out, standingAt(vehicle, 0, 1));
    ASSERT_TRUE(out.pose.sensor_pose);
    EXPECT_NEAR((*out.pose.sensor_pose - (vehicle + scanFrom(0)->sensorPose)).norm(), 0, 1e-9);
    segmenter.process(*scanFrom(0), out, standingAt(vehicle, 5, 6));
    EXPECT_FALSE(out.pose.sensor_pose);
    EXPECT_EQ(out.remark, "");
}

TEST(ObservationSegmenter, LogsRemarksOnly) {
    ObservationSegmenter segmenter;
    segmenter.logging_enable_console_output = false;
    std::vector<std::string> warnings;
    segmenter.logRegisterCallback([&](std::string_view text, mrpt::system::VerbosityLevel level,
                                      std::string_view, mrpt::Clock::time_point) {
        if (level == mrpt::system::LVL_WARN) warnings.emplace_back(text);
    });
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    EXPECT_THAT(warnings, testing::IsEmpty());
    CObservationVelodyneScan empty;
    empty.sensorLabel = "rear";
    segmenter.process(empty, out);
    EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("rear: " + out.remark)));
    EXPECT_THAT(out.remark, HasSubstr("no packets"));
}

/// A mask around the pole that scanFrom(0) sees at (12, 2), 2 m above the ground.
Settings withMaskedPole() {
    Settings settings;
    settings.airframe.parts.boxes = {{{11, 1, -1.95f}, {13, 3, 5}}};
    return settings;
}

TEST(ObservationSegmenter, MasksTheAirframe) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    const std::size_t pole = out.roi->pointcloud->size(), returns = out.scan->size();
    ASSERT_GT(pole, 30u);
    EXPECT_EQ(out.returns_masked, 0u);

    segmenter.initialize(withMaskedPole());
    segmenter.process(*scanFrom(0), out);
    EXPECT_GT(out.returns_masked, 30u);
    EXPECT_EQ(out.scan->size(), returns);
    EXPECT_EQ(out.roi->pointcloud->size() + out.non_roi->pointcloud->size(),
              returns - out.returns_masked);
    EXPECT_EQ(out.result->returns.unclassified.size(), out.returns_masked);
    for (const std::uint32_t i : out.result->returns.unclassified) {
        EXPECT_GT(out.scan->x_m[i], 11);
        EXPECT_TRUE(std::isnan(out.scan->range_m[i]));
    }
    for (const float x_m : out.roi->pointcloud->getPointsBufferRef_x()) EXPECT_LT(x_m, 11);
}

TEST(ObservationSegmenter, KeepsIntensitiesOnRequest) {
    ObservationSegmenter segmenter;
    segmenter.cloud_class = CloudClass::WithIntensity;
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    const auto roi = std::dynamic_pointer_cast<IntensityCloud>(out.roi->pointcloud);
    ASSERT_NE(roi, nullptr);
    ASSERT_GT(roi->size(), 0u);
    for (std::size_t i = 0; i < roi->size(); ++i) {
        ASSERT_EQ(roi->getPointIntensity(i), out.scan->intensity[out.result->returns.roi[i]]);
    }
}

TEST(ObservationSegmenter, AdaptsToChangedSensor) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    EXPECT_EQ(out.sensor->rows(), 16);
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    auto other = encodeScan(model, test::fireAt({}, model, {0, 0, 2}));
    other->sensorLabel = "front";
    segmenter.process(*other, out);
    EXPECT_EQ(out.sensor->rows(), 32);
    EXPECT_EQ(out.result->labels.rows(), 32);
}

/// A pole at (12, 2) on flat ground, without its sensor.
mrpt::obs::CObservationPointCloud::Ptr cloudFrom(const SensorModel& sensor, int columns) {
    test::SimpleScene scene;
    scene.poles.push_back({12, 2, 0.15, 8});
    return observationOf(test::scanScene(scene, sensor, columns, {0, 0, 2}).scan, "front",
                         mrpt::Clock::fromDouble(100));
}

TEST(ObservationSegmenter, RecoversTheSensorOfClouds) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    const auto cloud = cloudFrom(sensorModel("HDL-64E"), 600);
    for (int i = 0; i < 3; ++i) {
        const SegmentationResult* before = out.result;
        ASSERT_TRUE(segmenter.process(*cloud, out));
        EXPECT_EQ(out.sensor->name, "HDL-64E");
        EXPECT_EQ(out.result->labels.rows(), 64);
        EXPECT_EQ(out.result->labels.cols(), 600);
        EXPECT_EQ(out.options->columns, 600);
        ASSERT_TRUE(out.recovered);
        EXPECT_FALSE(out.is_sensor_assumed);
        EXPECT_TRUE(i == 0 || out.result == before);  // of the same filter
    }
    EXPECT_GT(out.roi->pointcloud->size(), 50u);
}

TEST(ObservationSegmenter, AdaptsColumnsToFullerClouds) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    const auto columnsOf = [&](int columns) {
        segmenter.process(*cloudFrom(sensorModel("HDL-32E"), columns), out);
        return out.result->labels.cols();
    };
    EXPECT_EQ(columnsOf(300), 300);
    EXPECT_EQ(columnsOf(600), 600);
    EXPECT_EQ(columnsOf(300), 600);
}

TEST(ObservationSegmenter, PrefersNamedSensor) {
    Settings settings;
    settings.sensor.model = "HDL-32E";
    ObservationSegmenter segmenter;
    segmenter.initialize(settings);
    ObservationSegmenter::Output out;
    segmenter.process(*cloudFrom(sensorModel("HDL-64E"), 600), out);
    EXPECT_EQ(out.result->labels.rows(), 32);
    EXPECT_EQ(out.result->labels.cols(), 870);
    EXPECT_FALSE(out.recovered);
    segmenter.initialize({});
    segmenter.process(*cloudFrom(sensorModel("HDL-64E"), 600), out);
    EXPECT_EQ(out.result->labels.rows(), 64);
}

TEST(ObservationSegmenter, AssumesVlp16ForTinyClouds) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    segmenter.process(*cloudFrom(sensorModel("HDL-32E"), 10), out);
    EXPECT_TRUE(out.is_sensor_assumed);
    EXPECT_EQ(out.sensor->name, "VLP-16");
    segmenter.process(*cloudFrom(sensorModel("HDL-32E"), 500), out);
    EXPECT_EQ(out.sensor->name, "HDL-32E");
    segmenter.process(*cloudFrom(sensorModel("HDL-32E"), 10), out);
    EXPECT_EQ(out.sensor->name, "HDL-32E");
}

TEST(ObservationSegmenter, UsesGivenBeams) {
    CloudSensors sensors;
    const auto cloud = cloudFrom(sensorModel("HDL-32E"), 500);
    sensors.see(*cloud);
    const SharedBeams beams = sensors.beamsOf("front");
    ObservationSegmenter fresh, used;
    ObservationSegmenter::Output expected, out;
    for (int i = 0; i < 5; ++i) used.process(*cloudFrom(sensorModel("VLP-16"), 900), out);
    EXPECT_EQ(out.sensor->name, "VLP-16");
    fresh.process(*cloudFrom(sensorModel("HDL-32E"), 10), expected, ScanPose(), beams);
    used.process(*cloudFrom(sensorModel("HDL-32E"), 10), out, ScanPose(), beams);
    EXPECT_EQ(out.sensor->name, "HDL-32E");
    EXPECT_EQ(out.recovered, beams);
    EXPECT_EQ(out.result->returns.label, expected.result->returns.label);
}

TEST(ObservationSegmenter, RejectsWindowBeyondRecoveredRows) {
    Settings settings;
    settings.options.window_size = 12;
    ObservationSegmenter segmenter;
    segmenter.initialize(settings);
    ObservationSegmenter::Output out;
    const SensorModel few = customSensorModel({-30, -25, -20, -15, -10, -5, 0, 5});
    EXPECT_THROW(segmenter.process(*cloudFrom(few, 500), out), SettingsError);
    segmenter.initialize({});
    EXPECT_TRUE(segmenter.process(*cloudFrom(few, 500), out));
    EXPECT_LE(out.options->window_size, 4);
}

TEST(ObservationSegmenter, RejectsOptionsBeyondTheSensor) {
    Settings settings;
    settings.options.window_size = 20;
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    EXPECT_NO_THROW(segmenter.initialize(settings));
    EXPECT_THROW(segmenter.process(*scanFrom(0), out), SettingsError);
    settings.sensor.model = "VLP-16";
    EXPECT_THROW(segmenter.initialize(settings), SettingsError);
}

TEST(ObservationSegmenter, RejectsUnknownModels) {
    auto scan = scanFrom(0);
    scan->scan_packets[0].velodyne_model_ID = 0x77;
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    EXPECT_THROW(segmenter.process(*scan, out), std::runtime_error);
}

TEST(ObservationSegmenter, AcceptsKnownPoses) {
    const auto poseWithPitch = [](double pitch_rad) {
        mrpt::obs::CObservationRobotPose pose;
        pose.timestamp = scanFrom(0)->timestamp;
        pose.pose.mean = mrpt::poses::CPose3D(0, 0, 0, 0, pitch_rad, 0);
        return pose;
    };
    const Trajectory vehicle = standingAt(mrpt::poses::CPose3D(1, 2, 3, 0, 0, 0), -0.5, 0.5);
    ObservationSegmenter in_order, elsewhere;
    ObservationSegmenter::Output expected, out;
    Horizon horizon;
    in_order.see(poseWithPitch(0.1));
    horizon.see(poseWithPitch(0.1));
    const ScanPose pose = scanPoseOf(*scanFrom(0), vehicle, horizon);
    ASSERT_TRUE(in_order.process(*scanFrom(0), expected, vehicle));
    in_order.see(poseWithPitch(0.3));

    ASSERT_TRUE(elsewhere.process(*scanFrom(0), out, pose));
    ASSERT_TRUE(out.pose.attitude && out.pose.sensor_pose);
    EXPECT_EQ(out.pose.attitude->pitch_rad, expected.pose.attitude->pitch_rad);
    EXPECT_EQ(*out.pose.sensor_pose, *expected.pose.sensor_pose);
    EXPECT_TRUE(out.pose.pose_has_horizon);
    EXPECT_EQ(out.result->returns.label, expected.result->returns.label);
}

TEST(ObservationSegmenter, MeasuresTimeToLabels) {
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(segmenter.process(*scanFrom(0), out));
    EXPECT_GT(out.time_to_labels.count(), 0);
    EXPECT_LT(out.time_to_labels, std::chrono::steady_clock::now() - start);
}

TEST(ObservationSegmenter, ProfilesOnRequest) {
    ObservationSegmenter segmenter;
    segmenter.profiler.enable();
    ObservationSegmenter::Output out;
    segmenter.process(*scanFrom(0), out);
    EXPECT_GT(segmenter.profiler.getMeanTime("process"), 0.0);
    EXPECT_GT(segmenter.profiler.getMeanTime("process.segment"), 0.0);
    segmenter.profiler.clear(true);  // otherwise it prints when destroyed
}

}  // namespace
}  // namespace hagen::observations
