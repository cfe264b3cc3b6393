#include <gtest/gtest.h>
#include <hagen/observations/Mount.h>
#include <hagen/range_image/Angle.h>

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;

Attitude tilt(double roll_deg, double pitch_deg) {
    return {static_cast<float>(radians(roll_deg)), static_cast<float>(radians(pitch_deg))};
}

void expectTilt(const std::optional<Attitude>& is, const Attitude& expected) {
    ASSERT_TRUE(is.has_value());
    EXPECT_LT((levelFromSensor(*is) - levelFromSensor(expected)).norm(), 1e-5f);
}

TEST(Mount, OfALevelSensorChangesNothing) {
    EXPECT_FALSE(sensorTilt({}, CPose3D(), {}).has_value());
    ScanPose pose;
    pose.attitude = tilt(3, -5);
    expectTilt(sensorTilt(pose, CPose3D(1, 2, 3, 0.5, 0, 0), {}), tilt(3, -5));
}

TEST(Mount, IsThatOfTheRecordingOnALevelVehicleWithoutAPose) {
    expectTilt(sensorTilt({}, CPose3D(0, 0, 0, 0.7, 0, radians(180)), {}), tilt(180, 0));
    expectTilt(sensorTilt({}, CPose3D(0, 0, 0, 0, radians(20), 0), tilt(90, 0)), tilt(0, 20));
}

// ScanPose::attitude is already that of the sensor on the vehicle.
TEST(Mount, OfTheRecordingIsNotAppliedTwice) {
    ScanPose pose;
    pose.attitude = tilt(175, 4);
    expectTilt(sensorTilt(pose, CPose3D(0, 0, 0, 0, 0, radians(180)), tilt(180, 0)), tilt(175, 4));
}

TEST(Mount, OfTheSettingsCountsWhereTheRecordingSaysNothing) {
    expectTilt(sensorTilt({}, CPose3D(), tilt(90, -10)), tilt(90, -10));
    ScanPose vehicle;
    vehicle.attitude = tilt(5, 0);
    expectTilt(sensorTilt(vehicle, CPose3D(), tilt(180, 0)), tilt(185, 0));
    // Nose down by 8 degrees, then turned about its own forward axis.
    vehicle.attitude = tilt(0, 8);
    expectTilt(sensorTilt(vehicle, CPose3D(), tilt(90, 0)), tilt(90, 8));
    vehicle.is_of_sensor = true;
    expectTilt(sensorTilt(vehicle, CPose3D(), tilt(90, 0)), tilt(0, 8));
}

}  // namespace
}  // namespace hagen::observations
