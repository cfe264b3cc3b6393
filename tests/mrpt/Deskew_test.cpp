#include "mrpt/Deskew.h"
#include <gtest/gtest.h>
#include <hagen/mrpt/VelodyneObservation.h>

#include <cmath>

#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using mrpt::poses::CPose3D;
const auto kStart = mrpt::Clock::fromDouble(1000.0);

/// A vehicle that flies at this velocity for one second, starting 2 m up.
Trajectory flight(double vx_m_s, double vz_m_s) {
    Trajectory vehicle;
    for (int i = 0; i <= 10; ++i) {
        const double t = 0.1 * i;
        vehicle.add(mrpt::Clock::fromDouble(1000.0 + t),
                    CPose3D(vx_m_s * t, 0, 2 + vz_m_s * t, 0, 0, 0));
    }
    return vehicle;
}

/// A full revolution during this flight over flat ground, with a wall 10 m ahead of the start.
Scan scanOnTheWay(double vx_m_s, double vz_m_s) {
    const test::SimpleScene scene = test::sceneOf({{{10, -30, 0}, {11, 30, 10}}});
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    Scan scan;
    decodePackets(*encodeScan(model, test::fireAt(scene, model, {0, 0, 2}, {vx_m_s, 0, vz_m_s})),
                  scan);
    return scan;
}

/// Maximum distance of returns from the ground 2 m below or from the wall 10 m ahead.
double worstDistance_m(const Scan& scan) {
    double worst = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double to_ground = std::abs(scan.z_m[i] + 2.0),
                     to_wall = std::abs(scan.x_m[i] - 10.0);
        worst = std::max(worst, std::min(to_ground, to_wall));
    }
    return worst;
}

TEST(Deskew, CorrectsTranslation) {
    Scan scan = scanOnTheWay(15, 3);
    EXPECT_GT(worstDistance_m(scan), 0.25);
    ASSERT_TRUE(deskew(flight(15, 3), kStart, {}, sensorModel("VLP-16"), scan));
    EXPECT_LT(worstDistance_m(scan), 0.01);  // packets resolve 2 mm
}

TEST(Deskew, UsesSensorPoseOnVehicle) {
    // The same flight, with a sensor mounted off-centre and rotated.
    const CPose3D sensor_on_vehicle(0.5, -0.2, 0.3, 1.2, 0.1, -0.2);
    Trajectory vehicle;
    for (int i = 0; i <= 10; ++i) {
        const double t = 0.1 * i;
        vehicle.add(mrpt::Clock::fromDouble(1000.0 + t),
                    CPose3D(15 * t, 0, 2 + 3 * t, 0, 0, 0) + (-sensor_on_vehicle));
    }
    Scan scan = scanOnTheWay(15, 3);
    ASSERT_TRUE(deskew(vehicle, kStart, sensor_on_vehicle, sensorModel("VLP-16"), scan));
    EXPECT_LT(worstDistance_m(scan), 0.01);
}

TEST(Deskew, CorrectsRotation) {
    // The map point (10, 0, 0), seen by a sensor that rotates in place.
    Trajectory vehicle;
    for (int i = 0; i <= 10; ++i) {
        vehicle.add(mrpt::Clock::fromDouble(1000.0 + 0.01 * i), CPose3D(0, 0, 0, 0.05 * i, 0, 0));
    }
    Scan scan;
    for (int i = 0; i < 100; ++i) {
        const double t = 0.001 * i, yaw = 5.0 * t;
        scan.x_m.push_back(static_cast<float>(10 * std::cos(yaw)));
        scan.y_m.push_back(static_cast<float>(-10 * std::sin(yaw)));
        scan.z_m.push_back(0.0f);
        scan.intensity.push_back(0.5f);
        scan.time_s.push_back(static_cast<float>(t));
    }
    ASSERT_TRUE(deskew(vehicle, kStart, {}, sensorModel("VLP-16"), scan));
    for (std::size_t i = 0; i < scan.size(); ++i) {
        ASSERT_NEAR(scan.x_m[i], 10.0f, 1e-3f);
        ASSERT_NEAR(scan.y_m[i], 0.0f, 1e-3f);
        ASSERT_NEAR(scan.azimuth_rad[i], 0.0f, 1e-3f);
    }
}

TEST(Deskew, KeepsScanWithoutMotion) {
    Scan scan = scanOnTheWay(0, 0);
    const Scan before = scan;
    ASSERT_TRUE(deskew(flight(0, 0), kStart, {}, sensorModel("VLP-16"), scan));
    for (std::size_t i = 0; i < scan.size(); ++i) {
        ASSERT_NEAR(scan.x_m[i], before.x_m[i], 1e-5f);
        ASSERT_EQ(scan.row[i], before.row[i]);
    }
}

TEST(Deskew, KeepsScanWithoutFullCoverage) {
    Trajectory vehicle;
    vehicle.add(mrpt::Clock::fromDouble(1000.0), {});
    vehicle.add(mrpt::Clock::fromDouble(1000.05), CPose3D(1, 0, 0, 0, 0, 0));
    Scan scan = scanOnTheWay(15, 0);
    const Scan before = scan;
    EXPECT_FALSE(deskew(vehicle, kStart, {}, sensorModel("VLP-16"), scan));
    EXPECT_EQ(scan.x_m, before.x_m);
    EXPECT_FALSE(deskew(Trajectory(), kStart, {}, sensorModel("VLP-16"), scan));
    // One implausible pose also prevents the correction.
    vehicle.add(mrpt::Clock::fromDouble(1000.07), CPose3D(1e300, 0, 0, 0, 0, 0));
    vehicle.add(mrpt::Clock::fromDouble(1000.2), CPose3D(2, 0, 0, 0, 0, 0));
    EXPECT_FALSE(deskew(vehicle, kStart, {}, sensorModel("VLP-16"), scan));
    EXPECT_EQ(scan.x_m, before.x_m);
    Scan nothing;
    EXPECT_TRUE(deskew(vehicle, kStart, {}, sensorModel("VLP-16"), nothing));
}

}  // namespace
}  // namespace hagen::observations
