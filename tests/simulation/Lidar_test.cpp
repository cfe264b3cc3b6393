#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/Lidar.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "simulation/SimpleContent.h"

namespace hagen::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using test::emptyContent;
using test::plane;
using test::put;

SensorErrorModel noFaults() {
    SensorErrorModel none;
    none.footprint_rad = none.min_noise_m = none.lost = none.mixed = none.dust_per_m = 0;
    none.half_range_m = 1e6;
    none.airframe = false;
    return none;
}

FlightSettings flightAt(double altitude_m, double speed_m_s, double tilt_sd_deg) {
    FlightSettings settings;
    settings.altitude_m = altitude_m;
    settings.speed_m_s = speed_m_s;
    settings.tilt_sd_rad = radians(tilt_sd_deg);
    return settings;
}

struct Simulation {
    Simulation(SceneContent content, const FlightSettings& settings,
               const std::string& name = "VLP-16")
        : scene(std::move(content)),
          flight(scene.terrain(), scene.path(), settings, 5),
          sensor(sensorModel(name)) {}

    SimulatedScan scan(double time_s, const SensorErrorModel& faults, std::uint64_t seed = 1,
                       const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity()) const {
        Random random(seed);
        return simulateScan(scene, sensor, flight, time_s, random, faults, mount);
    }
    /// A return in map coordinates.
    Eigen::Vector3d inMap(const SimulatedScan& scan, std::size_t i, double start_s) const {
        const SensorPose pose = flight.at(start_s + static_cast<double>(scan.scan.time_s[i]));
        return pose.position_m +
               pose.attitude * Eigen::Vector3f(scan.scan.x_m[i], scan.scan.y_m[i], scan.scan.z_m[i])
                                   .cast<double>();
    }

    Scene scene;
    Flight flight;
    SensorModel sensor;
};

SceneContent level() {
    SceneContent content = emptyContent();
    put(content, ObjectClass::Terrain, 0, plane(300));
    return content;
}

class EachSensor : public testing::TestWithParam<const char*> {};

TEST_P(EachSensor, ExactReturnsLieOnGround) {
    const Simulation setup(level(), flightAt(3, 8, 10), GetParam());
    const SimulatedScan scan = setup.scan(7.3, noFaults());
    ASSERT_GT(scan.size(), 5000u);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        // Rays start at the position of their firing; lasers fire slightly later.
        const double range_m = static_cast<double>(scan.scan.range_m[i]);
        ASSERT_NEAR(setup.inMap(scan, i, 7.3).z(), 0, 1e-3 + 1e-4 * range_m) << i;
        ASSERT_EQ(scan.kind[i], ObjectClass::Terrain);
    }
}

TEST_P(EachSensor, PartsEqualWholeTurn) {
    const Simulation setup(level(), flightAt(3, 8, 10), GetParam());
    const SimulatedScan whole = setup.scan(7.3, noFaults());
    const auto pose_at = [&](double time_s) { return setup.flight.at(time_s); };
    Random random(2);
    std::size_t at = 0;
    const int all = firingPattern(setup.sensor).firings_per_revolution;
    for (int first = 0; first < all; first += 101) {  // not a multiple of the batch size
        const int end = std::min(first + 101, all);
        const SimulatedScan part = simulateFirings(setup.scene, setup.sensor, pose_at, 7.3,
                                                   {first, end}, random, noFaults());
        for (std::size_t i = 0; i < part.size(); ++i, ++at) {
            ASSERT_EQ(part.firing[i], whole.firing[at]);
            ASSERT_EQ(part.laser[i], whole.laser[at]);
            ASSERT_EQ(part.scan.time_s[i], whole.scan.time_s[at]);
            ASSERT_EQ(part.scan.x_m[i], whole.scan.x_m[at]);
            ASSERT_EQ(part.scan.y_m[i], whole.scan.y_m[at]);
            ASSERT_EQ(part.scan.z_m[i], whole.scan.z_m[at]);
        }
    }
    EXPECT_EQ(at, whole.size());
}

TEST(LidarTest, PartsNeedNoLaterPoses) {
    const Simulation setup(level(), flightAt(3, 8, 10));
    double last_s = 0;
    const auto pose_at = [&](double time_s) {
        last_s = std::max(last_s, time_s);
        return setup.flight.at(time_s);
    };
    Random random(1);
    simulateFirings(setup.scene, setup.sensor, pose_at, 7.3, {100, 360}, random);
    EXPECT_LE(last_s, 7.3 + 360 * 55.296e-6 + 0.015);
    EXPECT_GE(last_s, 7.3 + 360 * 55.296e-6);
    for (const FiringRange wrong : {FiringRange{-1, 5}, {5, 5}, {7, 5}, {1800, 1810}}) {
        EXPECT_THROW(simulateFirings(setup.scene, setup.sensor, pose_at, 7.3, wrong, random),
                     std::invalid_argument);
    }
}

TEST_P(EachSensor, ReturnsFollowFiringOrder) {
    const Simulation setup(level(), flightAt(3, 4, 4), GetParam());
    const SimulatedScan scan = setup.scan(0, noFaults());
    const FiringPattern pattern = firingPattern(setup.sensor);
    std::set<int> lasers;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Scan& s = scan.scan;
        ASSERT_EQ(s.row[i], pattern.row_of_laser[scan.laser[i]]);
        ASSERT_NEAR(std::asin(s.z_m[i] / s.range_m[i]), setup.sensor.elevations_rad[s.row[i]],
                    1e-5);
        const double turned = std::remainder(
            static_cast<double>(s.azimuth_rad[i]) - std::atan2(s.y_m[i], s.x_m[i]), 2 * kPi);
        ASSERT_NEAR(turned, 0, 1e-5);
        lasers.insert(scan.laser[i]);
        if (i == 0) continue;
        const bool is_later =
            scan.firing[i] > scan.firing[i - 1] ||
            (scan.firing[i] == scan.firing[i - 1] && scan.laser[i] > scan.laser[i - 1]);
        ASSERT_TRUE(is_later) << i;
        ASSERT_GE(s.time_s[i], s.time_s[i - 1]);
    }
    EXPECT_LT(scan.scan.time_s.back(), 0.1001f);
    EXPECT_GE(lasers.size(), 7u);
}

INSTANTIATE_TEST_SUITE_P(All, EachSensor, testing::Values("VLP-16", "HDL-32E", "HDL-64E"),
                         [](const auto& sensor) { return std::string(sensor.param).erase(3, 1); });

TEST(LidarTest, StartsBehindAndTurnsClockwise) {
    const Simulation setup(level(), flightAt(3, 4, 0));
    const SimulatedScan scan = setup.scan(0, noFaults());
    EXPECT_NEAR(std::abs(scan.scan.azimuth_rad.front()), kPi, 0.01);
    EXPECT_NEAR(scan.scan.azimuth_rad[scan.size() / 4], kPi / 2, 0.05);
    EXPECT_NEAR(scan.scan.azimuth_rad[3 * scan.size() / 4], -kPi / 2, 0.05);
}

/// Expects range errors with this standard deviation.
void expectNoise(const Simulation& setup, double noise_m) {
    SensorErrorModel faults = noFaults();
    faults.min_noise_m = noise_m;
    const SimulatedScan exact = setup.scan(0, noFaults()), noisy = setup.scan(0, faults);
    ASSERT_EQ(exact.size(), noisy.size());
    double squares = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        squares += std::pow(static_cast<double>(noisy.scan.range_m[i] - exact.scan.range_m[i]), 2);
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(exact.size())), noise_m, 0.001);
}

TEST(LidarTest, LosesWeakReturnsFirst) {
    const Simulation setup(level(), flightAt(2, 4, 0));
    SensorErrorModel faults = noFaults();
    faults.half_range_m = SensorErrorModel().half_range_m;
    const SimulatedScan all = setup.scan(0, noFaults()), some = setup.scan(0, faults);
    const auto count = [](const SimulatedScan& scan, int row) {
        return static_cast<double>(std::count(scan.scan.row.begin(), scan.scan.row.end(), row));
    };
    EXPECT_GT(count(some, 0), 0.99 * count(all, 0));  // 8 m away
    EXPECT_LT(count(some, 7), 0.5 * count(all, 7));   // 115 m away, with the beam at 1 degree
}

/// Share of firings of the beam at 1 degree that hit a horizontal wire of 24 mm around the sensor
/// at the beam's height.
double shareHittingWire(double distance_m) {
    const FlightSettings hover = flightAt(3, 1e-3, 0);
    const SceneContent empty = emptyContent();
    const Eigen::Vector3d from = Flight(empty.terrain, empty.path, hover, 5).at(0).position_m;
    std::vector<Eigen::Vector4f> knots;
    for (int i = 0; i <= 720; ++i) {
        const double angle = i * kPi / 360;
        knots.push_back(Eigen::Vector4d(from.x() + distance_m * std::cos(angle),
                                        from.y() + distance_m * std::sin(angle),
                                        from.z() + distance_m * std::tan(radians(1.0)), 0.012)
                            .cast<float>());
    }
    SceneContent content = emptyContent();
    Shape wire;
    wire.addRod(knots);
    put(content, ObjectClass::Wire, 1, std::move(wire));
    SensorErrorModel faults = noFaults();
    faults.footprint_rad = SensorErrorModel().footprint_rad;
    return static_cast<double>(Simulation(std::move(content), hover).scan(0, faults).size()) / 1809;
}

TEST(LidarTest, WireHitsMatchCoverage) {
    EXPECT_GT(shareHittingWire(4), 0.99);
    EXPECT_NEAR(shareHittingWire(12), 0.024 / (12 * 0.003), 0.05);
    EXPECT_NEAR(shareHittingWire(24), 0.024 / (24 * 0.003), 0.05);
}

TEST(LidarTest, BeamsPassWires) {
    SceneContent content = level();
    const Simulation bare(level(), flightAt(3, 4, 4));
    Shape wire;
    wire.addRod({{-50, -4, 2.5f, 0.012f}, {50, -4, 2.5f, 0.012f}});
    put(content, ObjectClass::Wire, 1, std::move(wire));
    SensorErrorModel faults = noFaults();
    faults.footprint_rad = SensorErrorModel().footprint_rad;
    const SimulatedScan scan = Simulation(std::move(content), flightAt(3, 4, 4)).scan(0, faults);
    const auto wires = std::count(scan.kind.begin(), scan.kind.end(), ObjectClass::Wire);
    const auto grounds = std::count(scan.kind.begin(), scan.kind.end(), ObjectClass::Terrain);
    const auto before = static_cast<std::ptrdiff_t>(bare.scan(0, faults).size());
    EXPECT_GT(wires, 20);
    EXPECT_LE(grounds, before);
    EXPECT_GE(grounds + wires, before);
}

TEST(LidarTest, MeasuresLargeSurfacesOnAxis) {
    const Simulation setup(level(), flightAt(3, 4, 0));
    SensorErrorModel faults = noFaults();
    faults.footprint_rad = 0.003;
    const SimulatedScan scan = setup.scan(0, faults);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (scan.scan.range_m[i] > 40) continue;
        ASSERT_NEAR(setup.inMap(scan, i, 0).z(), 0, 5e-3) << i;
    }
}

TEST(LidarTest, MixesRangesAtEdges) {
    SceneContent content = emptyContent();
    Shape steps;  // bars 0.6 m in front of a wall, to the right of the path
    steps.addBox({-40, -19, -5}, {40, -18, 20});
    for (float x = -30; x < 30; x += 0.4f) steps.addBox({x, -17.5f, -5}, {x + 0.2f, -17.4f, 20});
    put(content, ObjectClass::Vehicle, 1, std::move(steps));
    SensorErrorModel faults = noFaults();
    faults.footprint_rad = 0.003;
    const Simulation setup(std::move(content), flightAt(3, 1, 0));
    const auto between = [&](const SensorErrorModel& with) {
        const SimulatedScan scan = setup.scan(0, with);
        int count = 0;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const double y = setup.inMap(scan, i, 0).y();
            count += y < -17.6 && y > -17.9;
        }
        return count;
    };
    EXPECT_EQ(between(faults), 0);
    faults.mixed = 0.3;
    EXPECT_GT(between(faults), 10);
}

TEST(LidarTest, GrassReturnsAboveSoil) {
    SceneContent content = level();
    TerrainParameters form;
    form.max_slope_rad = form.bump_m = 0;
    form.grass_m = 0.2;
    Random random(1);
    content.terrain = Terrain(form, random);
    const Simulation setup(std::move(content), flightAt(3, 4, 0));
    const SimulatedScan scan = setup.scan(0, noFaults());
    double sum = 0, max = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double z = setup.inMap(scan, i, 0).z();
        ASSERT_GT(z, -5e-3);
        max = std::max(max, z);
        sum += z;
    }
    EXPECT_LE(max, 0.205);
    EXPECT_GT(sum / static_cast<double>(scan.size()), 0.01);
}

TEST(LidarTest, LabelsDustAndAirframe) {
    const Simulation setup(level(), flightAt(3, 4, 4));
    SensorErrorModel faults = noFaults();
    faults.dust_per_m = 1e-3;
    faults.airframe = true;
    const SimulatedScan scan = setup.scan(0, faults);
    int dust = 0, airframe = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (scan.kind[i] == ObjectClass::Dust) ++dust;
        if (scan.kind[i] != ObjectClass::Airframe) continue;
        ++airframe;
        EXPECT_GT(scan.scan.range_m[i], 0.2f);
        EXPECT_LT(scan.scan.range_m[i], 0.7f);
    }
    EXPECT_GT(dust, 150);
    EXPECT_LT(dust, 500);
    EXPECT_GT(airframe, 50);
}

Eigen::Vector3d pointOf(const SimulatedScan& scan, std::size_t i) {
    return Eigen::Vector3f(scan.scan.x_m[i], scan.scan.y_m[i], scan.scan.z_m[i]).cast<double>();
}

Eigen::Quaterniond mountedAt(double roll_deg, double pitch_deg) {
    return Eigen::AngleAxisd(radians(pitch_deg), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(radians(roll_deg), Eigen::Vector3d::UnitX());
}

TEST(LidarTest, AppliesMount) {
    const Simulation setup(level(), flightAt(3, 8, 10));
    for (const auto& [roll_deg, pitch_deg] : {std::pair{180.0, 0.0}, {0.0, 90.0}, {-35.0, 20.0}}) {
        const Eigen::Quaterniond mount = mountedAt(roll_deg, pitch_deg);
        const SimulatedScan scan = setup.scan(7.3, noFaults(), 1, mount);
        ASSERT_GT(scan.size(), 5000u);
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const SensorPose vehicle =
                setup.flight.at(7.3 + static_cast<double>(scan.scan.time_s[i]));
            const Eigen::Vector3d in_map =
                vehicle.position_m + vehicle.attitude * (mount * pointOf(scan, i));
            const double range_m = static_cast<double>(scan.scan.range_m[i]);
            ASSERT_NEAR(in_map.z(), 0, 1e-3 + 1e-4 * range_m) << i;
        }
        const SensorPose vehicle = setup.flight.at(7.3);
        EXPECT_TRUE(scan.pose.attitude.isApprox(vehicle.attitude * mount));
        EXPECT_EQ(scan.pose.position_m, vehicle.position_m);
        EXPECT_EQ(scan.altitude_m, vehicle.position_m.z());
    }
}

TEST(LidarTest, AirframeStaysWithVehicle) {
    // Azimuth and range of the four legs below the vehicle's horizon.
    const std::vector<std::pair<double, double>> legs{
        {0.80, 0.42}, {2.35, 0.44}, {-0.78, 0.41}, {-2.38, 0.45}};
    SensorErrorModel faults = noFaults();
    faults.airframe = true;
    const Simulation setup(emptyContent(), flightAt(3, 4, 4), "HDL-32E");
    struct Case {
        double roll_deg, pitch_deg;
        std::size_t legs_in_view;
    };
    for (const auto& [roll_deg, pitch_deg, legs_in_view] :
         {Case{0, 0, 4}, {180, 0, 4}, {170, 20, 2}, {0, 20, 4}}) {
        const Eigen::Quaterniond mount = mountedAt(roll_deg, pitch_deg);
        const SimulatedScan scan = setup.scan(0, faults, 1, mount);
        std::set<std::size_t> seen;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            ASSERT_EQ(scan.kind[i], ObjectClass::Airframe);
            const Eigen::Vector3d on_vehicle = mount * pointOf(scan, i);
            if (on_vehicle.z() > 0) continue;  // skips the rotors
            const double azimuth = std::atan2(on_vehicle.y(), on_vehicle.x());
            bool is_leg = false;
            for (std::size_t leg = 0; leg < legs.size(); ++leg) {
                if (std::abs(azimuth - legs[leg].first) > 0.046) continue;
                EXPECT_NEAR(on_vehicle.norm(), legs[leg].second, 1e-5);
                is_leg = true;
                seen.insert(leg);
            }
            ASSERT_TRUE(is_leg) << roll_deg << " " << azimuth;
        }
        EXPECT_EQ(seen.size(), legs_in_view) << roll_deg;
    }
}

TEST(LidarTest, NearerSoilHidesLegs) {
    SensorErrorModel faults = noFaults();
    faults.airframe = true;
    const Simulation setup(level(), flightAt(0.15, 4, 0), "HDL-32E");
    const SimulatedScan scan = setup.scan(0, faults);
    for (std::size_t i = 0; i < scan.size(); ++i) ASSERT_GT(setup.inMap(scan, i, 0).z(), -0.01);
}

/// A sensor inside a building, where every beam has a return.
Simulation indoors(const std::string& sensor) {
    const FlightSettings hover = flightAt(3, 1e-3, 0);
    const SceneContent empty = emptyContent();
    const Eigen::Vector3f at =
        Flight(empty.terrain, empty.path, hover, 5).at(0).position_m.cast<float>();
    SceneContent content = emptyContent();
    Shape walls;
    walls.addBox(at - Eigen::Vector3f(25, 25, 25), at + Eigen::Vector3f(25, 25, 25));
    put(content, ObjectClass::Building, 1, std::move(walls));
    return {std::move(content), hover, sensor};
}

double elevationOf(const SimulatedScan& scan, std::size_t i) {
    const Eigen::Vector3d at = pointOf(scan, i);
    return degrees(std::asin(at.z() / at.norm()));
}

double azimuthOf(const SimulatedScan& scan, std::size_t i) {
    return degrees(static_cast<double>(scan.scan.azimuth_rad[i]));
}

struct FieldOfView {
    std::string sensor;
    std::size_t points, lines;
    double period_s, half_width_deg, lowest_deg, highest_deg;
};

/// Published fields of view and rates, and those of real frames of a Mid-360, which have 19 965
/// points (here: whole firings).
class WithoutRings : public testing::TestWithParam<FieldOfView> {};

TEST_P(WithoutRings, FillsFieldOfView) {
    const FieldOfView& view = GetParam();
    const Simulation setup = indoors(view.sensor);
    double left = -180, right = 180, lowest = 90, highest = -90;
    for (int frame = 0; frame < 10; ++frame) {
        const SimulatedScan scan = setup.scan(1.7 + 0.1 * frame, noFaults());
        ASSERT_EQ(scan.size(), view.points);
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const double elevation = elevationOf(scan, i), azimuth = azimuthOf(scan, i);
            lowest = std::min(lowest, elevation), highest = std::max(highest, elevation);
            right = std::min(right, azimuth), left = std::max(left, azimuth);
            ASSERT_EQ(scan.scan.row[i],
                      setup.sensor.nearestRow(static_cast<float>(radians(elevation))))
                << elevation;
            ASSERT_EQ(scan.laser[i], i % view.lines);
            ASSERT_EQ(scan.firing[i], static_cast<int>(i / view.lines));
            ASSERT_NEAR(scan.scan.time_s[i], view.period_s * static_cast<double>(i), 1e-7);
            const Eigen::Vector3d at = pointOf(scan, i);
            ASSERT_NEAR(std::remainder(azimuth - degrees(std::atan2(at.y(), at.x())), 360), 0,
                        1e-3);
        }
    }
    EXPECT_NEAR(left, view.half_width_deg, 0.1);
    EXPECT_NEAR(right, -view.half_width_deg, 0.1);
    EXPECT_NEAR(lowest, view.lowest_deg, 0.1);
    EXPECT_NEAR(highest, view.highest_deg, 0.1);
}

TEST_P(WithoutRings, FramesDiffer) {
    const Simulation setup = indoors(GetParam().sensor);
    std::set<std::pair<int, int>> cells;  // of a tenth of a degree
    std::size_t in_first = 0;
    for (const double time_s : {0.4, 0.5}) {
        in_first = cells.size();
        const SimulatedScan scan = setup.scan(time_s, noFaults());
        for (std::size_t i = 0; i < scan.size(); ++i) {
            cells.emplace(static_cast<int>(10 * azimuthOf(scan, i) + 1800),
                          static_cast<int>(10 * elevationOf(scan, i) + 900));
        }
    }
    EXPECT_GT(cells.size(), in_first + in_first / 2);
}

INSTANTIATE_TEST_SUITE_P(
    All, WithoutRings,
    testing::Values(FieldOfView{"Mid-360", 19964, 4, 0.1 / 19965, 180, -7.2, 53.2},
                    FieldOfView{"Avia", 24000, 6, 1 / 240e3, 35.2, -38.6, 38.6},
                    FieldOfView{"HAP", 45200, 4, 1 / 452e3, 60, -12.5, 12.5}),
    [](const auto& view) { return view.param.sensor.substr(0, 3); });

TEST(Mid360, LinesTurnSteadily) {
    const SimulatedScan scan = indoors("Mid-360").scan(1.7, noFaults());
    for (std::size_t i = 4; i < scan.size(); ++i) {
        ASSERT_NEAR(std::remainder(azimuthOf(scan, i - 4) - azimuthOf(scan, i), 360), 1.31, 0.005);
    }
}

TEST(Mid360, FramesBecomeUniform) {
    const Simulation setup = indoors("Mid-360");
    std::vector<bool> is_met(40 * 360);
    std::vector<double> filled;
    std::vector<int> by_azimuth(36), by_elevation(40);
    constexpr int kFrames = 20;
    for (int frame = 0; frame < kFrames; ++frame) {
        const SimulatedScan scan = setup.scan(0.1 * frame, noFaults());
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const int column = static_cast<int>(azimuthOf(scan, i) + 180) % 360;
            const int band =
                std::clamp(static_cast<int>((elevationOf(scan, i) + 7.2) / 60.4 * 40), 0, 39);
            is_met[static_cast<std::size_t>(band * 360 + column)] = true;
            ++by_azimuth[static_cast<std::size_t>(column / 10)];
            ++by_elevation[static_cast<std::size_t>(band)];
        }
        filled.push_back(static_cast<double>(std::count(is_met.begin(), is_met.end(), true)) /
                         static_cast<double>(is_met.size()));
    }
    EXPECT_NEAR(filled[0], 0.825, 0.01);
    EXPECT_NEAR(filled[1], 0.975, 0.01);
    EXPECT_GT(filled[2], 0.998);
    for (const int count : by_azimuth) EXPECT_NEAR(count, 19964 * kFrames / 36.0, 250);
    for (const int count : by_elevation) EXPECT_NEAR(count, 19964 * kFrames / 40.0, 250);
}

TEST(Mid360, HasErrorsFromManual) {
    const SensorErrorModel errors = sensorErrors(sensorModel("Mid-360"));
    EXPECT_EQ(errors.footprint_rad, SensorErrorModel().footprint_rad);
    EXPECT_LT(errors.half_range_m, SensorErrorModel().half_range_m);
    EXPECT_EQ(sensorErrors(sensorModel("VLP-16")).half_range_m, SensorErrorModel().half_range_m);
    EXPECT_EQ(errors.min_noise_m, 0.018);
    expectNoise(indoors("Mid-360"), errors.min_noise_m);  // walls are at 25 m and more
}

TEST(LidarTest, DependsOnSeedAndScene) {
    const Simulation setup(level(), flightAt(3, 4, 4));
    const SimulatedScan a = setup.scan(1, {}, 6), b = setup.scan(1, {}, 6),
                        c = setup.scan(1, {}, 7);
    EXPECT_EQ(a.scan.range_m, b.scan.range_m);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_NE(a.scan.range_m, c.scan.range_m);
    EXPECT_EQ(Simulation(emptyContent(), flightAt(3, 4, 4)).scan(0, noFaults()).size(), 0u);
}

TEST(LidarTest, RejectsOtherSensors) {
    EXPECT_THAT([] { firingPattern(sensorModel("VLP-32C")); },
                testing::ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("'VLP-32C'"), HasSubstr("VLP-16"), HasSubstr("HDL-32E"),
                          HasSubstr("Mid-360"))));
}

}  // namespace
}  // namespace hagen::simulation
