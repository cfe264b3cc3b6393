#include "filter/ground/Clearance.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include "filter/simd/GroundFrame.h"

#include <cmath>

#include "support/GroundPixels.h"
#include "support/Random.h"

namespace hagen {
namespace {

using test::pixelsAt;

/// Pixels in the frame of level ground `height_m` below the sensor.
Ground groundAt(float height_m, const PixelPoints& pixels) {
    Ground ground;
    ground.is_seen = true;
    ground.from_sensor = Eigen::Isometry3f(Eigen::Translation3f(0, 0, height_m));
    ground.pixels = pixels;
    return ground;
}

TEST(Clearance, GroundAboveLimitIsRoi) {
    const PixelPoints pixels =
        pixelsAt({{5, 0, 0}, {5, 0, 1}, {5, 0, 1.1f}, {5, 0, 4}, {5, 0, 0}, test::kEmptyPixel});
    Image<Label> labels = Image<Label>::Constant(1, 6, Label::Rou);
    labels(0, 4) = Label::Roi;
    labels(0, 5) = Label::Unclassified;
    Image<Label> expected = labels;
    expected(0, 2) = expected(0, 3) = Label::Roi;
    alarmLowGround(groundAt(3, pixels), {Eigen::Vector3f::UnitZ(), 2}, labels);
    EXPECT_TRUE((labels == expected).all());
}

TEST(Clearance, ZeroDisablesAlarm) {
    Image<Label> labels = Image<Label>::Constant(1, 1, Label::Rou);
    alarmLowGround(groundAt(3, pixelsAt({{5, 0, 9}})), {Eigen::Vector3f::UnitZ(), 0}, labels);
    EXPECT_EQ(labels(0, 0), Label::Rou);
}

// A level sensor is 3 m above ground that rises ahead by 15 degrees. Along gravity, the ground at x
// is 3 - x tan 15 below; along the ground normal, the distance is constant.
TEST(Clearance, FollowsGravityOverSlopes) {
    const float rise = static_cast<float>(std::tan(radians(15)));
    const auto points =
        test::groundPoints(20, 0.5f, [&](float x_m, float) { return rise * x_m - 3; });
    GroundFrameWorkspace work;
    for (const Attitude& attitude :
         {Attitude{}, Attitude{0.1f, -0.15f}}) {  // attitude of the airframe
        PixelPoints pixels = pixelsAt(points);
        Eigen::Isometry3f sensor_from_level = Eigen::Isometry3f::Identity();
        sensor_from_level.linear() = levelFromSensor(attitude).transpose();
        movePixels(sensor_from_level, pixels);
        const Eigen::Isometry3f frame = fitGroundFrame(pixels, attitude, work);
        movePixels(frame, pixels);

        Ground ground;
        ground.is_seen = true;
        ground.from_sensor = frame;
        ground.pixels = pixels;
        Image<Label> labels = Image<Label>::Constant(1, pixels.x_m.cols(), Label::Rou);
        alarmLowGround(ground, {upwards(ground, attitude), 2}, labels);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float clearance_m = -points[i].z();
            if (std::abs(clearance_m - 2) < 0.05f) continue;
            ASSERT_EQ(labels.data()[i], clearance_m < 2 ? Label::Roi : Label::Rou) << clearance_m;
        }
        labels.setConstant(Label::Rou);
        alarmLowGround(ground, {upwards(ground, std::nullopt), 2}, labels);
        EXPECT_TRUE((labels == Label::Rou).all());
        const float off_m = 3 * static_cast<float>(std::cos(radians(15)));
        alarmLowGround(ground, {upwards(ground, std::nullopt), off_m + 0.05f}, labels);
        EXPECT_TRUE((labels == Label::Roi).all());
    }
}

TEST(Clearance, FollowsSensorAxisWithoutGround) {
    Ground ground = groundAt(3, pixelsAt({{5, 0, 0}}));
    ground.from_sensor.linear() = levelFromSensor({0.4f, 0});
    EXPECT_EQ(upwards(ground, std::nullopt), Eigen::Vector3f::UnitZ());
    ground.is_seen = false;
    EXPECT_LT((upwards(ground, std::nullopt) - ground.from_sensor.linear().col(2)).norm(), 1e-6f);
}

}  // namespace
}  // namespace hagen
