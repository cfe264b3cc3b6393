#include "live/autopilot/GroundBelow.h"
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>
#include <Eigen/Geometry>

#include <cmath>

#include "support/SimpleScene.h"

namespace hagen::live {
namespace {

/// The scan of a sensor rotated by `level_from_sensor`.
Scan tilted(const Scan& level, const Eigen::Matrix3f& level_from_sensor) {
    Scan scan;
    for (std::size_t i = 0; i < level.size(); ++i) {
        const Eigen::Vector3f at_m = level_from_sensor.transpose() *
                                     Eigen::Vector3f(level.x_m[i], level.y_m[i], level.z_m[i]);
        scan.x_m.push_back(at_m.x());
        scan.y_m.push_back(at_m.y());
        scan.z_m.push_back(at_m.z());
    }
    locateBeams(sensorModel("VLP-16"), scan);
    return scan;
}

class GroundBelowTest : public testing::Test {
 protected:
    std::optional<float> below(
        const test::SimpleScene& scene, double altitude_m,
        const Eigen::Matrix3f& level_from_sensor = Eigen::Matrix3f::Identity(),
        const Eigen::Matrix3f& vehicle_from_sensor = Eigen::Matrix3f::Identity()) {
        const auto level = test::scanScene(scene, sensorModel("VLP-16"), 870, {0, 0, altitude_m});
        return groundBelow(filter_.segment(tilted(level.scan, level_from_sensor)).ground,
                           vehicle_from_sensor);
    }
    HagenFilter filter_{sensorModel("VLP-16")};
};

TEST_F(GroundBelowTest, LevelVehicleMeasuresAltitude) {
    for (const double altitude_m : {1.0, 2.0, 3.5}) {
        const auto distance_m = below({}, altitude_m);
        ASSERT_TRUE(distance_m) << altitude_m;
        EXPECT_NEAR(*distance_m, altitude_m, 0.05);
    }
}

TEST_F(GroundBelowTest, TiltedVehicleMeasuresAlongItsAxis) {
    const Eigen::Matrix3f roll =
        Eigen::AngleAxisf(0.2f, Eigen::Vector3f::UnitX()).toRotationMatrix();
    const auto distance_m = below({}, 2, roll);
    ASSERT_TRUE(distance_m);
    EXPECT_NEAR(*distance_m, 2 / std::cos(0.2), 0.06);
    // The vehicle is level; its sensor is mounted with a tilt.
    EXPECT_NEAR(*below({}, 2, roll, roll), 2, 0.06);
}

TEST_F(GroundBelowTest, UnknownWithoutGround) {
    EXPECT_FALSE(groundBelow(Ground(), Eigen::Matrix3f::Identity()));
    test::SimpleScene walls;
    walls.has_ground = false;
    walls.boxes = {{{5, -20, -20}, {6, 20, 20}}, {{-6, -20, -20}, {-5, 20, 20}}};
    EXPECT_FALSE(below(walls, 2));
}

}  // namespace
}  // namespace hagen::live
