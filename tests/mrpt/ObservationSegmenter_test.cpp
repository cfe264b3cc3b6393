#include <gmock/gmock.h>
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

/// A trajectory that stays at a pose between two times, in seconds after the scans' time.
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

class ObservationSegmenterTest : public testing::Test {
 protected:
    ObservationSegmenter segmenter_;
    ObservationSegmenter::Output out_;
};

TEST_F(ObservationSegmenterTest, IgnoresOtherObservations) {
    EXPECT_FALSE(segmenter_.process(mrpt::obs::CObservationComment(), out_));
    EXPECT_EQ(out_.roi, nullptr);
    ASSERT_TRUE(segmenter_.process(*scanFrom(0), out_));
    const auto non_roi = out_.non_roi;
    EXPECT_FALSE(segmenter_.process(*non_roi, out_));
}

TEST_F(ObservationSegmenterTest, CloudsKeepTimePoseAndLabel) {
    const auto scan = scanFrom(0);
    ASSERT_TRUE(segmenter_.process(*scan, out_));
    for (const auto& [cloud, label] :
         {std::pair{out_.roi, "front_roi"}, {out_.non_roi, "front_non_roi"}}) {
        EXPECT_EQ(cloud->sensorLabel, label);
        EXPECT_EQ(cloud->timestamp, scan->timestamp);
        EXPECT_EQ(cloud->sensorPose, scan->sensorPose);
        EXPECT_NE(std::dynamic_pointer_cast<PortableCloud>(cloud->pointcloud), nullptr);
    }
}

TEST_F(ObservationSegmenterTest, SplitsReturnsInOrder) {
    const auto scan = test::realVlp16Scan();
    if (!scan) GTEST_SKIP() << "mrpt-common is not installed";
    ASSERT_TRUE(segmenter_.process(*scan, out_));
    EXPECT_EQ(out_.roi->pointcloud->size() + out_.non_roi->pointcloud->size(), 22591u);
    Scan decoded;
    decodePackets(*scan, decoded);
    std::size_t next_roi = 0, next_rou = 0;
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        const bool is_roi = out_.result->returns.label[i] == Label::Roi;
        const auto& cloud = is_roi ? *out_.roi->pointcloud : *out_.non_roi->pointcloud;
        const std::size_t at = is_roi ? next_roi++ : next_rou++;
        ASSERT_EQ(cloud.getPointsBufferRef_x()[at], decoded.x_m[i]);
        ASSERT_EQ(cloud.getPointsBufferRef_z()[at], decoded.z_m[i]);
    }
}

TEST_F(ObservationSegmenterTest, IsReproducible) {
    segmenter_.process(*scanFrom(0), out_);
    const auto labels = out_.result->returns.label;
    segmenter_.process(*scanFrom(3), out_);
    segmenter_.process(*scanFrom(0), out_);
    EXPECT_EQ(out_.result->returns.label, labels);
}

TEST_F(ObservationSegmenterTest, UsesOneFilterPerLabel) {
    ObservationSegmenter::Output front, rear, again;
    segmenter_.process(*scanFrom(0, "front"), front);
    segmenter_.process(*scanFrom(0, "rear"), rear);
    segmenter_.process(*scanFrom(0, "front"), again);
    EXPECT_NE(rear.result, front.result);
    EXPECT_EQ(again.result, front.result);
}

TEST_F(ObservationSegmenterTest, ReportsSensorPose) {
    const mrpt::poses::CPose3D vehicle(1, 2, 3, 0.5, 0.1, 0);
    segmenter_.process(*scanFrom(0), out_, standingAt(vehicle, 0, 1));
    ASSERT_TRUE(out_.pose.sensor_pose);
    EXPECT_NEAR((*out_.pose.sensor_pose - (vehicle + scanFrom(0)->sensorPose)).norm(), 0, 1e-9);
    segmenter_.process(*scanFrom(0), out_, standingAt(vehicle, 5, 6));
    EXPECT_FALSE(out_.pose.sensor_pose);
    EXPECT_EQ(out_.remark, "");
}

TEST_F(ObservationSegmenterTest, LogsRemarksOnly) {
    segmenter_.logging_enable_console_output = false;
    std::vector<std::string> warnings;
    segmenter_.logRegisterCallback([&](std::string_view text, mrpt::system::VerbosityLevel level,
                                       std::string_view, mrpt::Clock::time_point) {
        if (level == mrpt::system::LVL_WARN) warnings.emplace_back(text);
    });
    segmenter_.process(*scanFrom(0), out_);
    EXPECT_THAT(warnings, testing::IsEmpty());
    CObservationVelodyneScan empty;
    empty.sensorLabel = "rear";
    segmenter_.process(empty, out_);
    EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("rear: " + out_.remark)));
    EXPECT_THAT(out_.remark, HasSubstr("no packets"));
}

/// Settings that mask the pole that scanFrom(0) sees at (12, 2), 2 m above the ground.
Settings withMaskedPole() {
    Settings settings;
    settings.airframe.parts.boxes = {{{11, 1, -1.95f}, {13, 3, 5}}};
    return settings;
}

TEST_F(ObservationSegmenterTest, MasksAirframe) {
    segmenter_.process(*scanFrom(0), out_);
    const std::size_t pole = out_.roi->pointcloud->size(), returns = out_.scan->size();
    ASSERT_GT(pole, 30u);
    EXPECT_EQ(out_.returns_masked, 0u);

    segmenter_.initialize(withMaskedPole());
    segmenter_.process(*scanFrom(0), out_);
    EXPECT_GT(out_.returns_masked, 30u);
    EXPECT_EQ(out_.scan->size(), returns);
    EXPECT_EQ(out_.roi->pointcloud->size() + out_.non_roi->pointcloud->size(),
              returns - out_.returns_masked);
    EXPECT_EQ(out_.result->returns.unclassified.size(), out_.returns_masked);
    for (const std::uint32_t i : out_.result->returns.unclassified) {
        EXPECT_GT(out_.scan->x_m[i], 11);
        EXPECT_TRUE(std::isnan(out_.scan->range_m[i]));
    }
    for (const float x_m : out_.roi->pointcloud->getPointsBufferRef_x()) EXPECT_LT(x_m, 11);
}

TEST_F(ObservationSegmenterTest, KeepsIntensitiesOnRequest) {
    segmenter_.cloud_class = CloudClass::WithIntensity;
    segmenter_.process(*scanFrom(0), out_);
    const auto roi = std::dynamic_pointer_cast<IntensityCloud>(out_.roi->pointcloud);
    ASSERT_NE(roi, nullptr);
    ASSERT_GT(roi->size(), 0u);
    for (std::size_t i = 0; i < roi->size(); ++i) {
        ASSERT_EQ((*intensitiesOf(*roi))[i], out_.scan->intensity[out_.result->returns.roi[i]]);
    }
}

TEST_F(ObservationSegmenterTest, AdaptsToChangedSensor) {
    segmenter_.process(*scanFrom(0), out_);
    EXPECT_EQ(out_.sensor->rows(), 16);
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    auto other = encodeScan(model, test::fireAt({}, model, {0, 0, 2}));
    other->sensorLabel = "front";
    segmenter_.process(*other, out_);
    EXPECT_EQ(out_.sensor->rows(), 32);
    EXPECT_EQ(out_.result->labels.rows(), 32);
}

/// A cloud without a sensor name: a pole at (12, 2) on flat ground.
mrpt::obs::CObservationPointCloud::Ptr cloudFrom(const SensorModel& sensor, int columns) {
    const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
    return observationOf(test::scanScene(scene, sensor, columns, {0, 0, 2}).scan, "front",
                         mrpt::Clock::fromDouble(100));
}

TEST_F(ObservationSegmenterTest, RecoversSensorFromClouds) {
    const auto cloud = cloudFrom(sensorModel("HDL-64E"), 600);
    for (int i = 0; i < 3; ++i) {
        const SegmentationResult* before = out_.result;
        ASSERT_TRUE(segmenter_.process(*cloud, out_));
        EXPECT_EQ(out_.sensor->name, "HDL-64E");
        EXPECT_EQ(out_.result->labels.rows(), 64);
        EXPECT_EQ(out_.result->labels.cols(), 600);
        EXPECT_EQ(out_.options->columns, 600);
        ASSERT_TRUE(out_.recovered);
        EXPECT_FALSE(out_.is_sensor_assumed);
        EXPECT_TRUE(i == 0 || out_.result == before);  // the filter is reused
    }
    EXPECT_GT(out_.roi->pointcloud->size(), 50u);
}

TEST_F(ObservationSegmenterTest, AdaptsColumnsToFullerClouds) {
    const auto columnsOf = [&](int columns) {
        segmenter_.process(*cloudFrom(sensorModel("HDL-32E"), columns), out_);
        return out_.result->labels.cols();
    };
    EXPECT_EQ(columnsOf(300), 300);
    EXPECT_EQ(columnsOf(600), 600);
    EXPECT_EQ(columnsOf(300), 600);
}

TEST_F(ObservationSegmenterTest, PrefersNamedSensor) {
    Settings settings;
    settings.sensor.model = "HDL-32E";
    segmenter_.initialize(settings);
    segmenter_.process(*cloudFrom(sensorModel("HDL-64E"), 600), out_);
    EXPECT_EQ(out_.result->labels.rows(), 32);
    EXPECT_EQ(out_.result->labels.cols(), 870);
    EXPECT_FALSE(out_.recovered);
    segmenter_.initialize({});
    segmenter_.process(*cloudFrom(sensorModel("HDL-64E"), 600), out_);
    EXPECT_EQ(out_.result->labels.rows(), 64);
}

TEST_F(ObservationSegmenterTest, AssumesVlp16ForTinyClouds) {
    segmenter_.process(*cloudFrom(sensorModel("HDL-32E"), 10), out_);
    EXPECT_TRUE(out_.is_sensor_assumed);
    EXPECT_EQ(out_.sensor->name, "VLP-16");
    segmenter_.process(*cloudFrom(sensorModel("HDL-32E"), 500), out_);
    EXPECT_EQ(out_.sensor->name, "HDL-32E");
    segmenter_.process(*cloudFrom(sensorModel("HDL-32E"), 10), out_);
    EXPECT_EQ(out_.sensor->name, "HDL-32E");
}

TEST_F(ObservationSegmenterTest, UsesGivenBeams) {
    CloudSensors sensors;
    const auto cloud = cloudFrom(sensorModel("HDL-32E"), 500);
    showCloud(*cloud, sensors);
    const SharedBeams beams = sensors.beamsOf("front");
    ObservationSegmenter fresh, used;
    ObservationSegmenter::Output expected;
    for (int i = 0; i < 5; ++i) used.process(*cloudFrom(sensorModel("VLP-16"), 900), out_);
    EXPECT_EQ(out_.sensor->name, "VLP-16");
    fresh.process(*cloudFrom(sensorModel("HDL-32E"), 10), expected, ScanPose(), beams);
    used.process(*cloudFrom(sensorModel("HDL-32E"), 10), out_, ScanPose(), beams);
    EXPECT_EQ(out_.sensor->name, "HDL-32E");
    EXPECT_EQ(out_.recovered, beams);
    EXPECT_EQ(out_.result->returns.label, expected.result->returns.label);
}

TEST_F(ObservationSegmenterTest, RejectsWindowBeyondRecoveredRows) {
    Settings settings;
    settings.options.window_size = 12;
    segmenter_.initialize(settings);
    const SensorModel few = customSensorModel({-30, -25, -20, -15, -10, -5, 0, 5});
    EXPECT_THROW(segmenter_.process(*cloudFrom(few, 500), out_), SettingsError);
    segmenter_.initialize({});
    EXPECT_TRUE(segmenter_.process(*cloudFrom(few, 500), out_));
    EXPECT_LE(out_.options->window_size, 4);
}

TEST_F(ObservationSegmenterTest, RejectsOptionsUnfitForSensor) {
    Settings settings;
    settings.options.window_size = 20;
    EXPECT_NO_THROW(segmenter_.initialize(settings));
    EXPECT_THROW(segmenter_.process(*scanFrom(0), out_), SettingsError);
    settings.sensor.model = "VLP-16";
    EXPECT_THROW(segmenter_.initialize(settings), SettingsError);
}

TEST_F(ObservationSegmenterTest, RejectsUnknownModels) {
    auto scan = scanFrom(0);
    scan->scan_packets[0].velodyne_model_ID = 0x77;
    EXPECT_THROW(segmenter_.process(*scan, out_), std::runtime_error);
}

TEST_F(ObservationSegmenterTest, AcceptsKnownPoses) {
    const auto poseWithPitch = [](double pitch_rad) {
        mrpt::obs::CObservationRobotPose pose;
        pose.timestamp = scanFrom(0)->timestamp;
        pose.pose.mean = mrpt::poses::CPose3D(0, 0, 0, 0, pitch_rad, 0);
        return pose;
    };
    const Trajectory vehicle = standingAt(mrpt::poses::CPose3D(1, 2, 3, 0, 0, 0), -0.5, 0.5);
    ObservationSegmenter in_order, elsewhere;
    ObservationSegmenter::Output expected;
    Horizon horizon;
    in_order.see(poseWithPitch(0.1));
    horizon.see(poseWithPitch(0.1));
    const ScanPose pose = scanPoseOf(*scanFrom(0), vehicle, horizon);
    ASSERT_TRUE(in_order.process(*scanFrom(0), expected, vehicle));
    in_order.see(poseWithPitch(0.3));

    ASSERT_TRUE(elsewhere.process(*scanFrom(0), out_, pose));
    ASSERT_TRUE(out_.pose.attitude && out_.pose.sensor_pose);
    EXPECT_EQ(out_.pose.attitude->pitch_rad, expected.pose.attitude->pitch_rad);
    EXPECT_EQ(*out_.pose.sensor_pose, *expected.pose.sensor_pose);
    EXPECT_TRUE(out_.pose.pose_has_horizon);
    EXPECT_EQ(out_.result->returns.label, expected.result->returns.label);
}

TEST_F(ObservationSegmenterTest, MeasuresTimeToLabels) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(segmenter_.process(*scanFrom(0), out_));
    EXPECT_GT(out_.time_to_labels.count(), 0);
    EXPECT_LT(out_.time_to_labels, std::chrono::steady_clock::now() - start);
}

TEST_F(ObservationSegmenterTest, ProfilesOnRequest) {
    segmenter_.profiler.enable();
    segmenter_.process(*scanFrom(0), out_);
    EXPECT_GT(segmenter_.profiler.getMeanTime("process"), 0.0);
    EXPECT_GT(segmenter_.profiler.getMeanTime("process.segment"), 0.0);
    segmenter_.profiler.clear(true);  // otherwise the profiler prints when destroyed
}

}  // namespace
}  // namespace hagen::observations
