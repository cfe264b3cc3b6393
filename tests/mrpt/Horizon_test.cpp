#include <gtest/gtest.h>
#include <hagen/mrpt/Horizon.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <cstring>

#include "../support/SimpleScene.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationRobotPose;
using mrpt::poses::CPose3D;

const mrpt::Clock::time_point kTime = mrpt::Clock::fromDouble(1000);

mrpt::Clock::time_point later(int by_ms) { return kTime + std::chrono::milliseconds(by_ms); }

CObservationRobotPose poseOf(const CPose3D& pose) {
    CObservationRobotPose observation;
    observation.timestamp = kTime;
    observation.pose.mean = pose;
    return observation;
}

TEST(Horizon, KeepsAttitudeFor200ms) {
    Horizon horizon;
    EXPECT_FALSE(horizon.at(kTime));
    horizon.see(poseOf({1, 2, 3, 0.5, 0.1, -0.2}));
    for (const int by_ms : {-199, 0, 199}) {
        const auto vehicle = horizon.at(later(by_ms));
        ASSERT_TRUE(vehicle) << by_ms;
        EXPECT_NEAR(vehicle->pitch(), 0.1, 1e-9);
        EXPECT_NEAR(vehicle->roll(), -0.2, 1e-9);
    }
    EXPECT_FALSE(horizon.at(later(-201)));
    EXPECT_FALSE(horizon.at(later(201)));
    horizon.forget();
    EXPECT_FALSE(horizon.at(later(0)));
}

TEST(Horizon, IgnoresInvalidTimes) {
    Horizon horizon;
    auto untimed = poseOf({0, 0, 0, 0, 0.1, 0});
    untimed.timestamp = INVALID_TIMESTAMP;
    horizon.see(untimed);
    EXPECT_FALSE(horizon.at(kTime));
    EXPECT_FALSE(horizon.at(INVALID_TIMESTAMP));
    horizon.see(poseOf({0, 0, 0, 0, 0.1, 0}));
    EXPECT_FALSE(horizon.at(INVALID_TIMESTAMP));
    EXPECT_TRUE(horizon.at(kTime));
}

TEST(Horizon, IgnoresNonFinitePoses) {
    const double nan = std::nan("");
    Horizon horizon;
    horizon.see(poseOf({0, 0, 0, 0, nan, 0}));
    EXPECT_FALSE(horizon.at(kTime));
    horizon.see(poseOf({0, 0, 0, 0, 0.1, 0}));
    horizon.see(poseOf({nan, 0, 0, 0, 0.2, 0}));
    auto displaced = poseOf({0, 0, 0, 0, 0.3, 0});
    displaced.sensorPose = CPose3D(0, nan, 0, 0, 0, 0);
    horizon.see(displaced);
    ASSERT_TRUE(horizon.at(kTime));
    EXPECT_NEAR(horizon.at(kTime)->pitch(), 0.1, 1e-9);
}

TEST(Horizon, KeepsLatestAttitude) {
    Horizon horizon;
    horizon.see(poseOf({0, 0, 0, 0, 0.1, 0}));
    horizon.see(poseOf({0, 0, 0, 0, 0.3, 0}));
    horizon.see(mrpt::obs::CObservationOdometry());  // has no attitude
    EXPECT_NEAR(horizon.at(kTime)->pitch(), 0.3, 1e-9);
}

TEST(Horizon, AppliesImuMount) {
    const CPose3D vehicle(0, 0, 0, 0, 0.1, 0.05), imu_on_vehicle(1, 0, 0, M_PI / 2, 0, 0.3);
    const CPose3D turned = vehicle + imu_on_vehicle;
    CObservationIMU imu;
    imu.timestamp = kTime;
    imu.sensorPose = imu_on_vehicle;
    imu.set(mrpt::obs::IMU_YAW, 2.0);  // a compass error is irrelevant
    imu.set(mrpt::obs::IMU_PITCH, turned.pitch());
    imu.set(mrpt::obs::IMU_ROLL, turned.roll());
    Horizon horizon;
    horizon.see(imu);
    EXPECT_NEAR(horizon.at(kTime)->pitch(), 0.1, 1e-6);
    EXPECT_NEAR(horizon.at(kTime)->roll(), 0.05, 1e-6);
}

TEST(Horizon, PrefersImuQuaternion) {
    CObservationIMU imu;
    imu.timestamp = kTime;
    imu.set(mrpt::obs::IMU_PITCH, 0.7);
    imu.set(mrpt::obs::IMU_ROLL, 0.7);
    imu.set(mrpt::obs::IMU_ORI_QUAT_W, std::cos(0.1));
    imu.set(mrpt::obs::IMU_ORI_QUAT_X, std::sin(0.1));
    imu.set(mrpt::obs::IMU_ORI_QUAT_Y, 0);
    imu.set(mrpt::obs::IMU_ORI_QUAT_Z, 0);
    Horizon horizon;
    horizon.see(imu);
    EXPECT_NEAR(horizon.at(kTime)->roll(), 0.2, 1e-9);
    EXPECT_NEAR(horizon.at(kTime)->pitch(), 0.0, 1e-9);

    imu.set(mrpt::obs::IMU_ORI_QUAT_W, 0);  // all zeros: an IMU without orientation
    imu.set(mrpt::obs::IMU_ORI_QUAT_X, 0);
    horizon.see(imu);
    EXPECT_NEAR(horizon.at(kTime)->roll(), 0.7, 1e-9);
}

TEST(Horizon, IgnoresInvalidImu) {
    Horizon horizon;
    CObservationIMU imu;
    imu.timestamp = kTime;
    const auto isIgnored = [&] {
        horizon.see(imu);
        return !horizon.at(kTime);
    };
    imu.set(mrpt::obs::IMU_X_ACC, 9.81);
    imu.set(mrpt::obs::IMU_PITCH, 0.1);  // pitch without roll is not an attitude
    EXPECT_TRUE(isIgnored());
    imu.set(mrpt::obs::IMU_ROLL, NAN);
    EXPECT_TRUE(isIgnored());
    imu.set(mrpt::obs::IMU_ROLL, 0.2);
    const unsigned char corrupt = 89;  // found by a fuzzer
    std::memcpy(&imu.dataIsPresent.at(mrpt::obs::IMU_ROLL), &corrupt, sizeof(corrupt));
    EXPECT_TRUE(isIgnored());

    CObservationIMU overflowing;
    overflowing.timestamp = kTime;
    for (const auto each : {mrpt::obs::IMU_ORI_QUAT_W, mrpt::obs::IMU_ORI_QUAT_X,
                            mrpt::obs::IMU_ORI_QUAT_Y, mrpt::obs::IMU_ORI_QUAT_Z}) {
        overflowing.set(each, 1e200);  // its square is infinite
    }
    horizon.see(overflowing);
    EXPECT_FALSE(horizon.at(kTime));

    imu.dataIsPresent.at(mrpt::obs::IMU_ROLL) = true;
    EXPECT_FALSE(isIgnored());
}

/// A cloud of level ground from a sensor mounted with a pitch.
mrpt::obs::CObservationPointCloud::Ptr cloudAt(const CPose3D& sensor_on_vehicle) {
    Settings settings;
    const auto scan = test::scanScene({}, settings.sensorModel(), 400, {0, 0, 2}).scan;
    auto cloud = observationOf(scan, "lidar", kTime);
    cloud->sensorPose = sensor_on_vehicle;
    return cloud;
}

TEST(Horizon, ReachesSegmenterOutput) {
    const auto cloud = cloudAt({0, 0, 0, 0, 0.2, 0});
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    ASSERT_TRUE(segmenter.process(*cloud, out));
    ASSERT_TRUE(out.pose.attitude);  // the vehicle is assumed to be level
    EXPECT_NEAR(out.pose.attitude->pitch_rad, 0.2, 1e-5);

    EXPECT_FALSE(segmenter.process(poseOf({0, 0, 5, 1.0, -0.05, 0.1}), out));
    ASSERT_TRUE(segmenter.process(*cloud, out));
    ASSERT_TRUE(out.pose.attitude);
    const CPose3D expected = CPose3D(0, 0, 0, 1.0, -0.05, 0.1) + cloud->sensorPose;
    EXPECT_NEAR(out.pose.attitude->pitch_rad, expected.pitch(), 1e-5);
    EXPECT_NEAR(out.pose.attitude->roll_rad, expected.roll(), 1e-5);

    segmenter.initialize({});  // clears the attitude
    ASSERT_TRUE(segmenter.process(*cloud, out));
    ASSERT_TRUE(out.pose.attitude);
    EXPECT_NEAR(out.pose.attitude->pitch_rad, 0.2, 1e-5);
    EXPECT_NEAR(out.pose.attitude->roll_rad, 0, 1e-5);
}

TEST(Horizon, ComesFromLevelTrajectoriesOnly) {
    const auto cloud = cloudAt({});
    Trajectory vehicle;
    vehicle.add(kTime, {0, 0, 0, 0, 0.15, 0});
    ObservationSegmenter segmenter;
    ObservationSegmenter::Output out;
    ASSERT_TRUE(segmenter.process(*cloud, out, vehicle));
    ASSERT_TRUE(out.pose.attitude);
    EXPECT_NEAR(out.pose.attitude->pitch_rad, 0.15, 1e-6);

    vehicle.has_horizon = false;
    ASSERT_TRUE(segmenter.process(*cloud, out, vehicle));
    EXPECT_TRUE(out.pose.sensor_pose);
    EXPECT_FALSE(out.pose.attitude);
}

}  // namespace
}  // namespace hagen::observations
