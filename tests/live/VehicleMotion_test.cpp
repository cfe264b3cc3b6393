#include "live/autopilot/VehicleMotion.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <limits>
#include <random>

#include "live/Vehicle.h"

namespace hagen::live {
namespace {

using MotionResult = VehicleMotion::Taken;

constexpr double kBehind_s = 50;  // delay of the vehicle's clock

/// Converts a rotation from MAVLink's frames to ours.
Eigen::Matrix3d ours(const Eigen::Matrix3d& ned_from_frd) {
    const Eigen::Vector3d flip(1, -1, -1);
    return flip.asDiagonal() * ned_from_frd * flip.asDiagonal();
}

TEST(VehicleMotion, AttitudeMessagesAgree) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-3, 3), tilt(-1.4, 1.4);
    for (int i = 0; i < 200; ++i) {
        Vehicle vehicle;
        vehicle.roll_rad = angle(random);
        vehicle.pitch_rad = tilt(random);
        vehicle.yaw_rad = angle(random);
        VehicleMotion euler, quaternion;
        EXPECT_EQ(euler.take(vehicle.attitude(10), 10 + kBehind_s), MotionResult::Attitude);
        EXPECT_EQ(quaternion.take(vehicle.quaternion(10), 10 + kBehind_s), MotionResult::Attitude);
        const Eigen::Matrix3d expected = ours(vehicle.nedFromFrd());
        for (const VehicleMotion* motion : {&euler, &quaternion}) {
            const auto pose = motion->at(10 + kBehind_s);
            ASSERT_TRUE(pose);
            EXPECT_TRUE(pose->map_from_vehicle.toRotationMatrix().isApprox(expected, 1e-5));
            EXPECT_FALSE(pose->place_m);
        }
    }
}

TEST(VehicleMotion, HeadingIsClockwise) {
    Vehicle vehicle;
    vehicle.yaw_rad = kPi / 2;
    vehicle.pitch_rad = 0.2;  // nose up
    vehicle.roll_rad = 0.1;   // right side down
    VehicleMotion motion;
    motion.take(vehicle.attitude(1), 1);
    const auto pose = motion.at(1);
    EXPECT_NEAR(pose->heading_rad(), -kPi / 2, 1e-6);
    const Eigen::Matrix3d level = levelFromVehicle(*pose);
    EXPECT_NEAR((level * Eigen::Vector3d::UnitX()).z(), std::sin(0.2), 1e-6);
    EXPECT_NEAR((level * Eigen::Vector3d::UnitX()).y(), 0, 1e-6);
    EXPECT_GT((level * Eigen::Vector3d::UnitY()).z(), 0.09);  // left side up
}

TEST(VehicleMotion, InterpolatesAndExtrapolates) {
    VehicleMotion motion;
    Vehicle vehicle;
    vehicle.rates_rad_s = {0, 0, 1};
    vehicle.speed_m_s = {4, -2, 1};
    for (int i = 0; i <= 10; ++i) {
        const double t = 0.1 * i;
        vehicle.yaw_rad = t;
        vehicle.ned_m = t * vehicle.speed_m_s;
        motion.take(vehicle.attitude(t), t + kBehind_s);
        motion.take(vehicle.place(t), t + kBehind_s);
    }
    const auto yawAt = [&](double t) { return -motion.at(t + kBehind_s)->heading_rad(); };
    EXPECT_NEAR(yawAt(0.55), 0.55, 1e-4);
    EXPECT_NEAR(yawAt(1.08), 1.08, 1e-4);
    EXPECT_NEAR(yawAt(1.4), 1.1, 1e-4);  // limit of extrapolation
    EXPECT_TRUE(
        motion.at(0.25 + kBehind_s)->place_m->isApprox(Eigen::Vector3d(1, 0.5, -0.25), 1e-4));
    EXPECT_TRUE(
        motion.at(1.15 + kBehind_s)->place_m->isApprox(1.15 * Eigen::Vector3d(4, 2, -1), 1e-4));
    // Position and attitude become unknown after 0.5 s.
    EXPECT_TRUE(motion.at(1.49 + kBehind_s));
    EXPECT_FALSE(motion.at(1.51 + kBehind_s));
    EXPECT_FALSE(motion.at(kBehind_s - 0.01));
}

TEST(VehicleMotion, PositionJumpCausesNoMotion) {
    VehicleMotion motion;
    Vehicle vehicle;
    vehicle.speed_m_s = {5, 0, 0};
    Eigen::Vector3d last_m = Eigen::Vector3d::Zero();
    for (int i = 0; i < 20; ++i) {
        const double t = 0.1 * i;
        vehicle.ned_m = t * vehicle.speed_m_s;
        if (i >= 10) vehicle.ned_m += Eigen::Vector3d(100, -30, 2);
        motion.take(vehicle.attitude(t), t);
        motion.take(vehicle.place(t), t);
        const Eigen::Vector3d place_m = *motion.at(t)->place_m;
        if (i > 0) {
            EXPECT_NEAR((place_m - last_m).norm(), 0.5, 1e-4) << i;
        }
        last_m = place_m;
    }
}

/// The estimate may jump within a gap, so earlier positions are not comparable.
TEST(VehicleMotion, JumpInGapCausesNoMotion) {
    VehicleMotion motion;
    Vehicle vehicle;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.01 * i;
        motion.take(vehicle.attitude(t), t);
        if (i == 100) vehicle.ned_m = {10, 0, 0};  // the estimator was reset
        if (i % 60 == 0) motion.take(vehicle.place(t), t);
        const auto now = motion.at(t);
        for (double before_s = 0; before_s <= 0.3; before_s += 0.05) {
            const auto then = motion.at(t - before_s);
            if (!now || !then) continue;
            EXPECT_LT(levelBetween(*then, *now).translation().norm(), 0.01) << t << " " << before_s;
        }
    }
    VehicleMotion slow;
    for (const double t : {0.0, 1.0}) {
        slow.take(vehicle.attitude(t), t);
        slow.take(vehicle.place(t), t);
        vehicle.ned_m.x() += 10;
    }
    EXPECT_TRUE(slow.at(1.0)->place_m);
    const auto between = slow.at(0.4);
    EXPECT_FALSE(between && between->place_m);
}

TEST(VehicleMotion, RejectsImpossibleMotion) {
    VehicleMotion motion;
    Vehicle vehicle;
    vehicle.roll_rad = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(motion.take(vehicle.attitude(1), 1), MotionResult::Refused);
    EXPECT_EQ(motion.take(vehicle.quaternion(1), 1), MotionResult::Refused);
    vehicle = Vehicle();
    vehicle.ned_m.x() = std::numeric_limits<double>::infinity();
    EXPECT_EQ(motion.take(vehicle.place(1), 1), MotionResult::Refused);
    vehicle = Vehicle();
    for (const double speed_m_s : {-101.0, 1e30}) {
        vehicle.speed_m_s.x() = speed_m_s;
        EXPECT_EQ(motion.take(vehicle.place(1), 1), MotionResult::Refused);
    }
    vehicle.speed_m_s.setZero();
    vehicle.ned_m.y() = 2e7;
    EXPECT_EQ(motion.take(vehicle.place(1), 1), MotionResult::Refused);
    for (const double rate_rad_s : {-51.0, 1e20}) {
        vehicle.rates_rad_s.z() = rate_rad_s;
        EXPECT_EQ(motion.take(vehicle.attitude(1), 1), MotionResult::Refused);
        EXPECT_EQ(motion.take(vehicle.quaternion(1), 1), MotionResult::Refused);
    }
    EXPECT_EQ(motion.take(mavlink::frameOf(mavlink::AttitudeQuaternion()), 1),
              MotionResult::Refused);
    EXPECT_EQ(motion.take(mavlink::frameOf(mavlink::Heartbeat()), 1), MotionResult::Other);
    EXPECT_FALSE(motion.at(1));
}

TEST(VehicleMotion, RestartClearsHistory) {
    VehicleMotion motion;
    Vehicle vehicle;
    motion.take(vehicle.attitude(100), 100);
    vehicle.yaw_rad = 1;
    motion.take(vehicle.attitude(1), 104);
    EXPECT_EQ(motion.restarts(), 0u);  // may be a message on a slower path
    EXPECT_FALSE(motion.at(104.01));
    motion.take(vehicle.attitude(1.5), 104.5);
    EXPECT_EQ(motion.restarts(), 1u);
    EXPECT_FALSE(motion.at(104.4));
    EXPECT_NEAR(motion.at(104.51).value().heading_rad(), -1, 1e-6);
}

TEST(LevelBetween, MovesFixedPoint) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(-3, 3), tilt(-0.5, 0.5), way(-20, 20);
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d place(way(random), way(random), way(random));
        Vehicle then, now;
        for (Vehicle* vehicle : {&then, &now}) {
            vehicle->yaw_rad = angle(random);
            vehicle->roll_rad = tilt(random);
            vehicle->pitch_rad = tilt(random);
        }
        now.ned_m = {tilt(random), tilt(random), tilt(random)};
        VehicleMotion motion;
        motion.take(then.attitude(1), 1);
        motion.take(then.place(1), 1);
        motion.take(now.attitude(1.1), 1.1);
        motion.take(now.place(1.1), 1.1);
        const auto at_then = *motion.at(1), at_now = *motion.at(1.1 + 1e-9);
        const Eigen::Vector3d moved =
            levelBetween(at_then, at_now) * (levelFromVehicle(at_then) * then.seen(place));
        const Eigen::Vector3d expected = levelFromVehicle(at_now) * now.seen(place);
        EXPECT_TRUE(moved.isApprox(expected, 1e-4))
            << moved.transpose() << " and " << expected.transpose();
        const double bearing_deg = degrees(-std::atan2(moved.y(), moved.x()));
        EXPECT_NEAR(std::remainder(bearing_deg - now.bearing_deg(place), 360), 0, 0.01);
    }
}

}  // namespace
}  // namespace hagen::live
