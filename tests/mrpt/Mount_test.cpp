#include "mrpt/Mount.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;

Attitude tilt(double roll_deg, double pitch_deg) {
    return {static_cast<float>(radians(roll_deg)), static_cast<float>(radians(pitch_deg))};
}

std::optional<Attitude> tiltOf(const ScanPose& pose, const CPose3D& recorded,
                               const Attitude& mount) {
    return mountedPose(pose, recorded, mount).attitude;
}

void expectTilt(const std::optional<Attitude>& is, const Attitude& expected) {
    ASSERT_TRUE(is.has_value());
    EXPECT_LT((levelFromSensor(*is) - levelFromSensor(expected)).norm(), 1e-5f);
}

TEST(Mount, KeepsLevelSensorAttitude) {
    EXPECT_FALSE(tiltOf({}, CPose3D(), {}).has_value());
    ScanPose pose;
    pose.attitude = tilt(3, -5);
    expectTilt(tiltOf(pose, CPose3D(1, 2, 3, 0.5, 0, 0), {}), tilt(3, -5));
}

TEST(Mount, UsesRecordedTiltWithoutPose) {
    expectTilt(tiltOf({}, CPose3D(0, 0, 0, 0.7, 0, radians(180)), {}), tilt(180, 0));
    expectTilt(tiltOf({}, CPose3D(0, 0, 0, 0, radians(20), 0), tilt(90, 0)), tilt(0, 20));
}

// ScanPose::attitude already includes the mount.
TEST(Mount, AppliesRecordedMountOnce) {
    ScanPose pose;
    pose.attitude = tilt(175, 4);
    expectTilt(tiltOf(pose, CPose3D(0, 0, 0, 0, 0, radians(180)), tilt(180, 0)), tilt(175, 4));
}

TEST(Mount, UsesSettingsForLevelRecording) {
    expectTilt(tiltOf({}, CPose3D(), tilt(90, -10)), tilt(90, -10));
    ScanPose vehicle;
    vehicle.attitude = tilt(5, 0);
    expectTilt(tiltOf(vehicle, CPose3D(), tilt(180, 0)), tilt(185, 0));
    // The vehicle is pitched down by 8 degrees, the sensor is turned about its forward axis.
    vehicle.attitude = tilt(0, 8);
    expectTilt(tiltOf(vehicle, CPose3D(), tilt(90, 0)), tilt(90, 8));
    vehicle.is_of_sensor = true;  // applies to the pose, not to the attitude
    expectTilt(tiltOf(vehicle, CPose3D(), tilt(90, 0)), tilt(90, 8));
    vehicle.attitude_is_of_sensor = true;
    expectTilt(tiltOf(vehicle, CPose3D(), tilt(90, 0)), tilt(0, 8));
}

/// A chain of transforms causes rounding errors.
TEST(Mount, ToleratesRoundedRecordedMount) {
    const CPose3D rounded(0, 0, 0, 0.3, 1e-7, -1e-9);
    expectTilt(tiltOf({}, rounded, tilt(180, 0)), tilt(180, 0));
    EXPECT_TRUE(tiltOf({}, rounded, {}).has_value());
    expectTilt(mountOf(tilt(1e-6, 0), tilt(180, 0)), tilt(180, 0));
    expectTilt(mountOf(tilt(1, 0), tilt(180, 0)), tilt(1, 0));
    expectTilt(tiltOf({}, CPose3D(0, 0, 0, 0, 0, radians(1)), tilt(180, 0)), tilt(1, 0));
}

TEST(Mount, SettingsAndRecordingAreEquivalent) {
    const Attitude mount = tilt(180, -20);
    const CPose3D vehicle(1, 2, 3, 0.3, 0.1, -0.05), place(0.1, 0, 0.2, 0.5, 0, 0);
    const CPose3D turned = place + CPose3D(0, 0, 0, 0, radians(-20), radians(180));
    ScanPose level, recorded;
    level.sensor_pose = vehicle + place;
    recorded.sensor_pose = vehicle + turned;
    const ScanPose by_settings = mountedPose(level, place, mount);
    const ScanPose by_recording = mountedPose(recorded, turned, {});
    EXPECT_LT(
        (by_settings.sensor_pose->asVectorVal() - by_recording.sensor_pose->asVectorVal()).norm(),
        1e-6);
    EXPECT_LT((by_settings.sensor_on_vehicle.asVectorVal() - turned.asVectorVal()).norm(), 1e-6);
    // Sensor poses and recorded mounts are not rotated.
    level.is_of_sensor = true;
    EXPECT_EQ(*mountedPose(level, place, mount).sensor_pose, *level.sensor_pose);
    EXPECT_EQ(*mountedPose(recorded, turned, mount).sensor_pose, *recorded.sensor_pose);
}

}  // namespace
}  // namespace hagen::observations
