#include "filter/image/Posture.h"
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "support/PointScan.h"
#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

Attitude tilt(double roll_deg, double pitch_deg = 0) {
    return {static_cast<float>(radians(roll_deg)), static_cast<float>(radians(pitch_deg))};
}

Posture postureOf(const std::optional<Attitude>& attitude) {
    return hagen::postureOf(attitude, sensorModel("VLP-16"));
}

TEST(Posture, FollowsSensorAxisTilt) {
    EXPECT_EQ(postureOf(std::nullopt), Posture::Upright);
    for (const auto& upright : {tilt(0), tilt(29), tilt(-29), tilt(0, 29), tilt(20, -20)})
        EXPECT_EQ(postureOf(upright), Posture::Upright);
    for (const auto& side : {tilt(31), tilt(90), tilt(-149), tilt(0, 80), tilt(180, 31)})
        EXPECT_EQ(postureOf(side), Posture::OnItsSide);
    for (const auto& down : {tilt(180), tilt(-180), tilt(151), tilt(180, 29), tilt(-160, 10)})
        EXPECT_EQ(postureOf(down), Posture::UpsideDown);
}

TEST(Posture, LevelsRinglessSensorsEarlier) {
    const SensorModel sensor = sensorModel("Mid-360");
    EXPECT_EQ(postureOf(tilt(14), sensor), Posture::Upright);
    EXPECT_EQ(postureOf(tilt(16), sensor), Posture::OnItsSide);
    EXPECT_EQ(postureOf(tilt(164), sensor), Posture::OnItsSide);
    EXPECT_EQ(postureOf(tilt(-166), sensor), Posture::UpsideDown);
}

TEST(Posture, ImageRowsRise) {
    for (const char* name : {"VLP-16", "HDL-64E"}) {
        const SensorModel sensor = sensorModel(name);
        for (const auto posture : {Posture::Upright, Posture::UpsideDown, Posture::OnItsSide}) {
            const SensorModel rows = sensorIn(posture, sensor);
            for (int row = 1; row < rows.rows(); ++row)
                EXPECT_GT(rows.elevations_rad[row], rows.elevations_rad[row - 1]);
            EXPECT_LE(rows.rows(), 256);
            EXPECT_EQ(rows.min_range_m, sensor.min_range_m);
        }
        const SensorModel down = sensorIn(Posture::UpsideDown, sensor);
        EXPECT_EQ(down.elevations_rad.front(), -sensor.elevations_rad.back());
    }
    EXPECT_EQ(sensorIn(Posture::OnItsSide, sensorModel("VLP-16")).rows(), 91);  // every 2 degrees
}

// The posture rotates the sensor frame into the image frame; the remaining tilt completes it.
TEST(Posture, FrameAndRestComposeTilt) {
    test::Random random(8);
    for (int k = 0; k < 200; ++k) {
        const Attitude attitude = tilt(static_cast<double>(random.real(-180, 180)),
                                       static_cast<double>(random.real(-89, 89)));
        const Posture posture = postureOf(attitude);
        const Eigen::Matrix3f level =
            levelFromSensor(*attitudeIn(posture, attitude)) * imageFromSensor(posture, attitude);
        EXPECT_LT((level - levelFromSensor(attitude)).norm(), 1e-5f);
        if (posture == Posture::UpsideDown) {
            EXPECT_EQ(postureOf(attitudeIn(posture, attitude)), Posture::Upright);
        }
    }
}

TEST(Posture, TurnedScanIsRotated) {
    const SensorModel sensor = sensorModel("VLP-16");
    test::Random random(9);
    std::vector<Eigen::Vector3f> points_m;
    for (int k = 0; k < 300; ++k) {
        points_m.push_back(test::onBeam(sensor, k % 16, static_cast<double>(random.real(-180, 180)),
                                        static_cast<double>(random.real(1, 40))));
    }
    const Scan scan = test::scanOf(sensor, points_m);
    for (const Attitude& attitude : {tilt(180), tilt(170, 12), tilt(90), tilt(40, -20)}) {
        const Posture posture = postureOf(attitude);
        const SensorModel rows = sensorIn(posture, sensor);
        Scan turned;
        turnScan(scan, posture, attitude, rows, turned);
        ASSERT_EQ(turned.size(), scan.size());
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const Eigen::Vector3f expected_m = imageFromSensor(posture, attitude) * points_m[i];
            EXPECT_NEAR(turned.x_m[i], expected_m.x(), 1e-4f);
            EXPECT_NEAR(turned.y_m[i], expected_m.y(), 1e-4f);
            EXPECT_NEAR(turned.z_m[i], expected_m.z(), 1e-4f);
            EXPECT_EQ(turned.range_m[i], scan.range_m[i]);
            EXPECT_EQ(turned.row[i],
                      rows.nearestRow(std::asin(expected_m.z() / turned.range_m[i])));
        }
        EXPECT_NO_THROW(checkLocated(turned, rows));
    }
}

TEST(Posture, TurningKeepsMissingRanges) {
    const SensorModel sensor = sensorModel("VLP-16");
    Scan scan = test::scanOf(sensor, {{5, 1, 0}, {4, 0, 0.5f}, {0, 2.65e-23f, 0}, {0, 0, 0}});
    scan.range_m[1] = kNoValue;     // masked airframe
    EXPECT_GT(scan.range_m[2], 0);  // so close that its squared coordinates are 0
    EXPECT_TRUE(std::isnan(scan.range_m[3]));
    for (const Attitude& attitude : {tilt(180), tilt(90), tilt(40, -20)}) {
        HagenFilter filter(sensor, {});
        const std::vector<Label>& label = filter.segment(scan, attitude).returns.label;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            EXPECT_EQ(label[i] == Label::Unclassified, std::isnan(scan.range_m[i])) << i;
        }
    }
}

/// Ground, a wall and a pole, seen from 2 m by a sensor with this tilt.
test::LabelledScan sceneFrom(const SensorModel& sensor, const Attitude& attitude) {
    const test::SimpleScene scene = test::sceneOf({{{8, -4, 0}, {9, 4, 3}}}, {{-6, 5, 0.2, 4}});
    return test::scanScene(scene, sensor, 870, {0, 0, 2}, levelFromSensor(attitude).cast<double>());
}

TEST(Posture, LabelsAreCorrectAtAnyRoll) {
    const SensorModel sensor = sensorModel("VLP-16");
    HagenFilter filter(sensor);
    for (const double roll_deg : {0.0, 20.0, 35.0, 60.0, 90.0, 120.0, 145.0, 160.0, 180.0, -90.0}) {
        const Attitude attitude = tilt(roll_deg);
        const test::LabelledScan seen = sceneFrom(sensor, attitude);
        const SegmentationResult& result = filter.segment(seen.scan, attitude);
        int obstacles = 0, missed = 0, ground = 0, mistaken = 0;
        for (std::size_t i = 0; i < seen.truth.size(); ++i) {
            if (seen.scan.range_m[i] > 20) continue;
            const bool is_roi = result.returns.label[i] == Label::Roi;
            (seen.truth[i] == Label::Roi ? obstacles : ground) += 1;
            missed += seen.truth[i] == Label::Roi && !is_roi;
            mistaken += seen.truth[i] == Label::Rou && is_roi;
        }
        SCOPED_TRACE(testing::Message()
                     << roll_deg << " degrees: missed " << missed << " of " << obstacles
                     << ", mistaken " << mistaken << " of " << ground);
        EXPECT_GT(obstacles, 100);
        EXPECT_LE(missed, 0.05 * obstacles);
        EXPECT_LE(mistaken, 0.03 * ground);
        // The transform starts in the sensor's own frame.
        const Eigen::Isometry3f& from_sensor = result.ground.from_sensor;
        EXPECT_NEAR(from_sensor.translation().z(), 2, 0.1f);
        EXPECT_LT((from_sensor.linear() - levelFromSensor(attitude)).norm(), 0.1f);
    }
}

TEST(Posture, UpsideDownWithoutAttitudeIsRoi) {
    const SensorModel sensor = sensorModel("VLP-16");
    const test::LabelledScan seen = sceneFrom(sensor, tilt(180));
    HagenFilter filter(sensor);
    const SegmentationResult& result = filter.segment(seen.scan);
    for (std::size_t i = 0; i < seen.truth.size(); ++i) {
        if (seen.scan.range_m[i] > 20) continue;
        ASSERT_EQ(result.returns.label[i], Label::Roi) << i;
    }
}

}  // namespace
}  // namespace hagen
