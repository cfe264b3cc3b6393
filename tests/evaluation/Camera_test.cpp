#include <gmock/gmock.h>
#include <hagen/evaluation/Camera.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/SensorModel.h>

#include <limits>

#include "support/PointScan.h"
#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

/// 9 x 7 pixels, 90 degrees wide: a return 45 degrees to the left is in the first column.
PinholeCamera smallCamera() {
    PinholeCamera camera;
    camera.width_px = 9;
    camera.height_px = 7;
    camera.fx_px = camera.fy_px = 4;
    camera.cx_px = 4;
    camera.cy_px = 3;
    return camera;
}

Scan cameraScanOf(const std::vector<Eigen::Vector3f>& points_m) {
    return test::scanOf(sensorModel("VLP-16"), points_m);
}

void expectAt(const PinholeCamera& camera, const Eigen::Vector3f& point_m, int u, int v) {
    const auto pixels = visibleReturns(camera, cameraScanOf({point_m}));
    ASSERT_EQ(pixels.size(), 1u) << point_m.transpose();
    EXPECT_EQ(pixels[0].u, u) << point_m.transpose();
    EXPECT_EQ(pixels[0].v, v) << point_m.transpose();
}

TEST(Camera, ProjectsDirectionsToPixels) {
    expectAt(smallCamera(), {5, 0, 0}, 4, 3);
    expectAt(smallCamera(), {5, 5, 0}, 0, 3);   // 45 degrees: 4 px from the centre
    expectAt(smallCamera(), {8, -4, 0}, 6, 3);  // slope 1/2: 2 px
    expectAt(smallCamera(), {8, 0, 6}, 4, 0);   // slope 3/4 up: 3 px
    expectAt(smallCamera(), {8, 0, -2}, 4, 4);
}

TEST(Camera, RoundsToNearestPixel) {
    expectAt(smallCamera(), {100, 12.4f, 0}, 4, 3);  // 0.496 px from the centre
    expectAt(smallCamera(), {100, 12.6f, 0}, 3, 3);
}

TEST(Camera, IgnoresReturnsOutsideView) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(
        visibleReturns(
            smallCamera(),
            cameraScanOf(
                {{-5, 0, 0}, {0, 5, 0}, {5, 6, 0}, {5, -6, 0}, {5, 0, 5}, {kNan, 0, 0}, {0, 0, 0}}))
            .empty());
    EXPECT_TRUE(visibleReturns(smallCamera(), Scan()).empty());
}

TEST(Camera, KeepsNearestReturnPerPixel) {
    const auto pixels =
        visibleReturns(smallCamera(), cameraScanOf({{9, 0, 0}, {3, 0, 0}, {6, 0, 0}}));
    ASSERT_EQ(pixels.size(), 1u);
    EXPECT_EQ(pixels[0].index, 1u);
}

TEST(Camera, AppliesPose) {
    PinholeCamera camera = smallCamera();
    camera.pose.translation() = Eigen::Vector3d(0, 1, 0);  // 1 m to the left of the sensor
    expectAt(camera, {5, 1, 0}, 4, 3);
    expectAt(camera, {4, 0, 0}, 5, 3);  // 1 m to the right of the camera at 4 m: 1 px
    camera = smallCamera();
    camera.pose.linear() = Eigen::AngleAxisd(radians(90), Eigen::Vector3d::UnitZ()).matrix();
    expectAt(camera, {0, 5, 0}, 4, 3);  // the camera looks to the left
}

const char* const kCameraFile =
    "width: 9\nheight: 7\nfx: 4\nfy: 4\ncx: 4\ncy: 3\nposition_m: [0.1, 0, -0.2]\n"
    "yaw_deg: 0\npitch_deg: 45\nroll_deg: 0\n";

TEST(CameraFile, PositivePitchLooksDown) {
    const test::TemporaryFolder folder;
    PinholeCamera camera = readCamera(folder.write("camera.yaml", kCameraFile));
    EXPECT_EQ(camera.width_px, 9);
    EXPECT_EQ(camera.height_px, 7);
    EXPECT_EQ(camera.pose.translation(), Eigen::Vector3d(0.1, 0, -0.2));
    camera.pose.translation().setZero();
    expectAt(camera, {5, 0, -5}, 4, 3);
}

TEST(CameraFile, ShippedFileLooksForward) {
    const PinholeCamera camera = readCamera(HAGEN_SOURCE_DIR "/config/camera_forward.yaml");
    const auto pixels = visibleReturns(camera, cameraScanOf({{10, 0, 0}}));
    ASSERT_EQ(pixels.size(), 1u);
    EXPECT_NEAR(pixels[0].u, camera.width_px / 2, 1);
    EXPECT_NEAR(pixels[0].v, camera.height_px / 2, 1);
}

TEST(CameraFile, ReportsWrongEntries) {
    const test::TemporaryFolder folder;
    const auto message = [&](const std::string& from, const std::string& to) {
        std::string text = kCameraFile;
        text.replace(text.find(from), from.size(), to);
        return test::messageOf([&] { readCamera(folder.write("camera.yaml", text)); });
    };
    const auto expect = [&](const std::string& from, const std::string& to,
                            const std::string& words) {
        EXPECT_THAT(message(from, to), HasSubstr(words));
    };
    expect("fy: 4\n", "", "camera.yaml: has no key 'fy'");
    expect("position_m: [0.1, 0, -0.2]\n", "", "has no key 'position_m'");
    expect("[0.1, 0, -0.2]", "[0.1, 0]", "camera.yaml:7: position_m must be [x, y, z]");
    expect("fx: 4", "fx: wide", "camera.yaml:3: fx must be a number, not 'wide'");
    expect("fx: 4", "fx: 0", "fx must be above 0");
    expect("width: 9", "width: 9.5", "width must be a whole number");
    expect("height: 7", "height: 0", "height must be");
    expect("width: 9\nheight: 7", "width: 10000\nheight: 10000", "more than 50 million pixels");
    expect("fx: 4", "focal: 4", "unknown key 'focal'");
    expect("fx: 4", "cx: 4", "'cx' occurs twice");
}

}  // namespace
}  // namespace hagen::evaluation
