#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/Flight.h>

#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

Terrain rolling() {
    TerrainParameters form;
    form.max_slope_rad = radians(5);
    Random random(5);
    return Terrain(form, random);
}

struct Tilt {
    double roll, pitch;
};
/// Roll and pitch of an attitude composed of rotations about z, then y, then x.
Tilt tiltOf(const SensorPose& pose) {
    const Eigen::Matrix3d r = pose.attitude.toRotationMatrix();
    return {std::atan2(r(2, 1), r(2, 2)), -std::asin(r(2, 0))};
}

TEST(FlightTest, KeepsAltitude) {
    const Terrain terrain = rolling();
    for (const double altitude_m : {1.0, 4.0, 15.0}) {
        FlightSettings settings;
        settings.altitude_m = altitude_m;
        const Flight flight(terrain, {30, 12}, settings, 3);
        double sum = 0;
        for (int i = 0; i < 600; ++i) {
            const Eigen::Vector3d at = flight.at(0.5 * i).position_m;
            const double above_m = at.z() - terrain.height_m(at.x(), at.y());
            EXPECT_GT(above_m, 0.7 * altitude_m - 0.1);
            EXPECT_LT(above_m, 1.3 * altitude_m + 0.1);
            sum += above_m;
        }
        EXPECT_NEAR(sum / 600, altitude_m, 0.06 * altitude_m);
    }
}

/// The flight is higher than over level ground by the mean height from 3 m behind to 3 m ahead.
TEST(FlightTest, FollowsMeanGroundHeight) {
    TerrainParameters form;
    form.max_slope_rad = form.bump_m = 0;
    Random random(5);
    const Terrain terrain = rolling(), level(form, random);
    FlightSettings settings;
    settings.altitude_m = 15;
    const Flight flight(terrain, {30, 12}, settings, 3), over_level(level, {30, 12}, settings, 3);
    int compared = 0;
    double highest_m = 0;
    for (double time_s = 0; time_s < 60; time_s += 0.3) {
        const Eigen::Vector3d at = flight.at(time_s).position_m,
                              step = flight.at(time_s + 1e-3).position_m - at;
        if (std::abs(step.y()) > 1e-9) continue;  // skips turns
        double ground_m = 0;
        for (int i = -3; i <= 3; ++i) ground_m += terrain.height_m(at.x() + i, at.y()) / 7;
        EXPECT_NEAR(at.z() - over_level.at(time_s).position_m.z(), ground_m, 1e-6);
        highest_m = std::max(highest_m, std::abs(ground_m));
        ++compared;
    }
    EXPECT_GT(compared, 50);
    EXPECT_GT(highest_m, 0.5);
}

TEST(FlightTest, TiltHasGivenDeviation) {
    for (const double sd_deg : {1.0, 4.0, 15.0}) {
        FlightSettings settings;
        settings.tilt_sd_rad = radians(sd_deg);
        settings.speed_m_s = 2;  // at this speed, turns add less than 1.1 degrees
        const Flight flight(rolling(), {1e4, 12}, settings, 3);
        constexpr int kCount = 4000;
        double roll = 0, roll2 = 0, pitch = 0, pitch2 = 0;
        for (int i = 0; i < kCount; ++i) {
            const Tilt tilt = tiltOf(flight.at(0.73 * i));
            roll += tilt.roll / kCount, roll2 += tilt.roll * tilt.roll / kCount;
            pitch += tilt.pitch / kCount, pitch2 += tilt.pitch * tilt.pitch / kCount;
        }
        EXPECT_NEAR(degrees(std::sqrt(roll2 - roll * roll)), sd_deg, 0.07 * sd_deg);
        EXPECT_NEAR(degrees(std::sqrt(pitch2 - pitch * pitch)), sd_deg, 0.07 * sd_deg);
    }
}

TEST(FlightTest, IsLevelWithoutTilt) {
    FlightSettings settings;
    settings.tilt_sd_rad = 0;
    const Path path{30, 12};
    const Flight flight(rolling(), path, settings, 3);
    for (double time_s = 0; time_s < 120; time_s += 1.7) {
        const SensorPose pose = flight.at(time_s);
        EXPECT_NEAR(tiltOf(pose).roll, 0, 1e-9);
        EXPECT_NEAR(tiltOf(pose).pitch, 0, 1e-9);
        const Eigen::Vector3d step = flight.at(time_s + 1e-3).position_m - pose.position_m;
        const Eigen::Vector3d ahead = pose.attitude * Eigen::Vector3d::UnitX();
        EXPECT_GT(ahead.head<2>().dot(step.head<2>().normalized()), 0.999);
    }
}

TEST(FlightTest, SlowsDownInTurns) {
    FlightSettings settings;
    settings.speed_m_s = 8;
    const Path path{60, 12};
    const Flight flight(rolling(), path, settings, 3);
    double slowest = 1e9, fastest = 0;
    for (double time_s = 0; time_s < 200; time_s += 0.5) {
        const Eigen::Vector3d a = flight.at(time_s).position_m;
        const Eigen::Vector3d b = flight.at(time_s + 0.01).position_m;
        const double speed = (b - a).head<2>().norm() / 0.01;
        slowest = std::min(slowest, speed);
        fastest = std::max(fastest, speed);
        EXPECT_LT(path.distance_m(a.x(), a.y()), 1e-6);
    }
    EXPECT_NEAR(fastest, 8, 0.05);
    EXPECT_NEAR(slowest * slowest / path.radius_m, 0.68, 0.05);  // a bank angle of 4 degrees
}

TEST(FlightTest, IsContinuous) {
    const Flight flight(rolling(), {10, 8}, {}, 3);
    for (double time_s = 0; time_s < 60; time_s += 0.01) {
        const SensorPose a = flight.at(time_s), b = flight.at(time_s + 0.01);
        ASSERT_LT((b.position_m - a.position_m).norm(), 0.08) << time_s;
        ASSERT_LT(degrees(a.attitude.angularDistance(b.attitude)), 1.5) << time_s;
    }
}

TEST(FlightTest, DependsOnSeed) {
    const Terrain terrain = rolling();
    const auto rollAt = [&](std::uint64_t seed) {
        return tiltOf(Flight(terrain, {30, 12}, {}, seed).at(3)).roll;
    };
    EXPECT_EQ(rollAt(1), rollAt(1));
    EXPECT_NE(rollAt(1), rollAt(2));
}

}  // namespace
}  // namespace hagen::simulation
