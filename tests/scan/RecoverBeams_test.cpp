#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RecoverBeams.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

/// Disturbances of a spinning sensor's returns.
struct Spin {
    int columns = 900;
    double jitter_deg = 0, rounding_m = 0, tilt_deg = 0;
    double dropped = 0, strays = 0;  ///< shares
    double nearest_m = 2, farthest_m = 60;
    std::set<int> dead_beams = {};
};

double rounded(double value_m, double step_m) {
    return step_m > 0 ? std::round(value_m / step_m) * step_m : value_m;
}

void add(const Eigen::Vector3d& point_m, Scan& scan) {
    scan.x_m.push_back(static_cast<float>(point_m.x()));
    scan.y_m.push_back(static_cast<float>(point_m.y()));
    scan.z_m.push_back(static_cast<float>(point_m.z()));
}

Scan scanOf(const std::vector<double>& beams_deg, const Spin& spin, unsigned seed = 1) {
    test::Random random(seed);
    std::normal_distribution<double> jitter_deg(0.0, std::max(spin.jitter_deg, 1e-9));
    const Eigen::AngleAxisd tilt(radians(spin.tilt_deg), Eigen::Vector3d::UnitX());
    Scan scan;
    for (int column = 0; column < spin.columns; ++column) {
        for (std::size_t beam = 0; beam < beams_deg.size(); ++beam) {
            if (spin.dead_beams.count(static_cast<int>(beam)) > 0) continue;
            if (random.chance(spin.dropped)) continue;
            double elevation_deg = beams_deg[beam] + jitter_deg(random.engine());
            if (random.chance(spin.strays)) {
                elevation_deg = static_cast<double>(random.real(
                    static_cast<float>(beams_deg.front()), static_cast<float>(beams_deg.back())));
            }
            const double range_m = static_cast<double>(random.real(
                static_cast<float>(spin.nearest_m), static_cast<float>(spin.farthest_m)));
            const double azimuth_rad = kPi - 2 * kPi * (column + 0.5) / spin.columns;
            const Eigen::Vector3d point_m =
                tilt * (range_m * test::directionOf(azimuth_rad, radians(elevation_deg)));
            add(point_m.unaryExpr([&](double m) { return rounded(m, spin.rounding_m); }), scan);
        }
    }
    return scan;
}

std::vector<double> beamsOf(const SensorModel& sensor) {
    std::vector<double> beams_deg;
    for (const float beam_rad : sensor.elevations_rad) {
        beams_deg.push_back(degrees(static_cast<double>(beam_rad)));
    }
    return beams_deg;
}

std::vector<std::string> spinningModels() {
    std::vector<std::string> names;
    for (const std::string& name : knownSensorModels()) {
        const bool is_vlp16 = name == "XT16";  // the same beams
        if (sensorModel(name).has_rings && !is_vlp16) names.push_back(name);
    }
    return names;
}

/// Uneven beams of an unknown model, at least `min_step_deg` apart.
std::vector<double> randomBeams(test::Random& random, int count, double min_step_deg) {
    std::vector<double> beams_deg{static_cast<double>(random.real(-40, -20))};
    for (int beam = 1; beam < count; ++beam) {
        const double step_deg = min_step_deg * static_cast<double>(random.real(1, 2.5));
        beams_deg.push_back(beams_deg.back() + step_deg);
    }
    return beams_deg;
}

void expectBeams(const std::optional<RecoveredBeams>& found, const std::vector<double>& truth_deg,
                 double tolerance_deg) {
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->sensor.has_rings) << found->share;
    const std::vector<double> found_deg = beamsOf(found->sensor);
    ASSERT_EQ(found_deg.size(), truth_deg.size());
    for (std::size_t beam = 0; beam < truth_deg.size(); ++beam) {
        EXPECT_NEAR(found_deg[beam], truth_deg[beam], tolerance_deg) << beam;
    }
}

/// Returns in random directions.
Scan randomScan(unsigned seed, int returns, float lowest_deg, float highest_deg) {
    test::Random random(seed);
    Scan scan;
    for (int i = 0; i < returns; ++i) {
        const double range_m = static_cast<double>(random.real(1, 60));
        const double azimuth_rad = static_cast<double>(random.real(-3.14f, 3.14f));
        const auto elevation_deg = static_cast<double>(random.real(lowest_deg, highest_deg));
        add(range_m * test::directionOf(azimuth_rad, radians(elevation_deg)), scan);
    }
    return scan;
}

TEST(RecoverBeams, FindsEveryKnownModel) {
    for (const std::string& name : spinningModels()) {
        SCOPED_TRACE(name);
        const SensorModel truth = sensorModel(name);
        const auto found = recoverBeams(scanOf(beamsOf(truth), {}));
        ASSERT_TRUE(found);
        EXPECT_EQ(found->sensor.name, name);
        EXPECT_EQ(found->sensor.elevations_rad, truth.elevations_rad);
        EXPECT_EQ(found->seen_rad.size(), truth.elevations_rad.size());
        EXPECT_GT(found->share, 0.99f);
        EXPECT_NEAR(found->max_columns, 900, 1);
    }
}

TEST(RecoverBeams, SurvivesJitterRoundingStraysAndDropouts) {
    Spin jitter, millimetres, centimetres, strays, dropouts, all;
    jitter.jitter_deg = 0.05;
    millimetres.rounding_m = 0.001;
    centimetres.rounding_m = 0.01;
    strays.strays = 0.05;
    dropouts.dropped = 0.5;
    all.jitter_deg = 0.04;
    all.rounding_m = 0.01;
    all.strays = 0.03;
    all.dropped = 0.5;
    for (const std::string& name : spinningModels()) {
        if (name == "VLS-128") continue;  // its beams are only 0.11 degrees apart
        const SensorModel truth = sensorModel(name);
        for (Spin spin : {jitter, millimetres, centimetres, strays, dropouts, all}) {
            spin.columns = 200;
            SCOPED_TRACE(name + ", jitter " + std::to_string(spin.jitter_deg) + ", rounding " +
                         std::to_string(spin.rounding_m) + ", strays " +
                         std::to_string(spin.strays) + ", dropped " + std::to_string(spin.dropped));
            const auto found = recoverBeams(scanOf(beamsOf(truth), spin));
            ASSERT_TRUE(found);
            EXPECT_EQ(found->sensor.name, name) << found->share;
        }
    }
}

TEST(RecoverBeams, AddsUnseenModelBeams) {
    for (const std::string& name : spinningModels()) {
        SCOPED_TRACE(name);
        const SensorModel truth = sensorModel(name);
        Spin spin;
        for (int beam = truth.rows() / 2 + 1; beam < truth.rows(); ++beam) {
            spin.dead_beams.insert(beam);  // beams that point at the sky
        }
        spin.dead_beams.insert(2);
        const auto found = recoverBeams(scanOf(beamsOf(truth), spin));
        ASSERT_TRUE(found);
        EXPECT_EQ(found->sensor.name, name);
        EXPECT_EQ(found->sensor.elevations_rad, truth.elevations_rad);
        EXPECT_EQ(found->seen_rad.size(), truth.elevations_rad.size() / 2);
    }
}

TEST(RecoverBeams, FewBeamsAreNotNamed) {
    for (const std::vector<double>& beams_deg :
         {std::vector<double>{-3, 4}, {-15, -13, -11, -9}, {-15, -11, -7, -3, 1, 5}}) {
        const auto found = recoverBeams(scanOf(beams_deg, {}));
        expectBeams(found, beams_deg, 0.01);
        EXPECT_EQ(found->sensor.name, kRecoveredName);
    }
    EXPECT_EQ(recoverBeams(scanOf({-15, -13, -11, -9, -7}, {}))->sensor.name, "VLP-16");
}

TEST(RecoverBeams, FindsRandomBeams) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        test::Random random(seed);
        const int count = random.whole(3, 100);
        const auto beams_deg = randomBeams(random, count, count > 50 ? 0.3 : 0.6);
        Spin spin;
        spin.columns = random.whole(200, 600);
        spin.jitter_deg = static_cast<double>(random.real(0, 0.025f));
        spin.strays = static_cast<double>(random.real(0, 0.03f));
        spin.dropped = static_cast<double>(random.real(0, 0.5f));
        spin.rounding_m = random.chance(0.5) ? 0.001 : 0;
        expectBeams(recoverBeams(scanOf(beams_deg, spin, seed)), beams_deg, 0.02);
    }
}

TEST(RecoverBeams, CountsSparseBeams) {
    const SensorModel truth = sensorModel("Puck Hi-Res");
    std::vector<double> beams_deg = beamsOf(truth);
    beams_deg[5] += 0.3;  // not a known model
    Scan scan = scanOf(beams_deg, {});
    const Scan all = scan;
    scan.clear();
    int kept_of_highest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double elevation_deg = degrees(
            static_cast<double>(std::atan2(all.z_m[i], std::hypot(all.x_m[i], all.y_m[i]))));
        if (elevation_deg > beams_deg[14] + 0.5 && ++kept_of_highest > 25) continue;
        add({all.x_m[i], all.y_m[i], all.z_m[i]}, scan);
    }
    expectBeams(recoverBeams(scan), beams_deg, 0.01);
}

TEST(RecoverBeams, IgnoresReturnsWithoutRange) {
    Scan scan = scanOf({-10, -5, 0, 5}, {});
    const auto expected = recoverBeams(scan);
    for (int i = 0; i < 2000; ++i) {
        add({0, 0, 0}, scan);
        add({1, std::numeric_limits<double>::quiet_NaN(), 2}, scan);
        add({1, 2, std::numeric_limits<double>::infinity()}, scan);
    }
    const auto found = recoverBeams(scan);
    EXPECT_EQ(found->sensor.elevations_rad, expected->sensor.elevations_rad);
    EXPECT_EQ(found->share, expected->share);
}

TEST(RecoverBeams, NeedsEnoughReturns) {
    EXPECT_FALSE(recoverBeams(Scan()));
    EXPECT_FALSE(recoverBeams(scanOf({-10, -5, 0}, {133})));  // 399 returns
    EXPECT_TRUE(recoverBeams(scanOf({-10, -5, 0, 5}, {100})));
}

TEST(RecoverBeams, TiltedOrBlurredCloudHasNoRings) {
    Spin tilted, blurred;
    tilted.columns = blurred.columns = 300;
    tilted.tilt_deg = 3;
    blurred.jitter_deg = 0.5;
    for (const std::string& name : spinningModels()) {
        for (const Spin& spin : {tilted, blurred}) {
            SCOPED_TRACE(name + ", tilt " + std::to_string(spin.tilt_deg));
            const auto found = recoverBeams(scanOf(beamsOf(sensorModel(name)), spin));
            ASSERT_TRUE(found);
            EXPECT_FALSE(found->sensor.has_rings) << found->share;
            EXPECT_TRUE(found->seen_rad.empty());
        }
    }
}

TEST(RecoverBeams, RandomCloudHasNoRings) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        test::Random random(seed);
        const int returns = random.whole(400, seed % 8 == 0 ? 40000 : 5000);
        const float lowest_deg = random.real(-60, 0), span_deg = random.real(5, 90);
        const auto found =
            recoverBeams(randomScan(seed, returns, lowest_deg, lowest_deg + span_deg));
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->sensor.has_rings) << returns << ", " << found->share;
    }
}

TEST(RecoverBeams, RejectsBandsAndFewRings) {
    const auto joined = [](Scan scan, const Scan& more) {
        for (std::size_t i = 0; i < more.size(); ++i) {
            add({more.x_m[i], more.y_m[i], more.z_m[i]}, scan);
        }
        return scan;
    };
    const Scan bands = joined(randomScan(1, 5000, -20, -10), randomScan(2, 5000, 10, 20));
    EXPECT_FALSE(recoverBeams(bands)->sensor.has_rings);
    // Only a fifth of the returns are on rings.
    const Scan few = joined(randomScan(1, 5000, -20, 20), scanOf({-15, -5, 5, 15}, {1250 / 4}));
    EXPECT_FALSE(recoverBeams(few)->sensor.has_rings);
}

TEST(RecoverBeams, VirtualRowsAreEven) {
    const auto found = recoverBeams(randomScan(1, 20000, -7, 52));
    ASSERT_TRUE(found);
    const std::vector<double> rows_deg = beamsOf(found->sensor);
    EXPECT_FALSE(found->sensor.has_rings);
    // Like the Mid-360 preset: 24 rows, 360 columns.
    EXPECT_GE(rows_deg.size(), 22u);
    EXPECT_LE(rows_deg.size(), 25u);
    EXPECT_NEAR(found->max_columns, 360, 10);
    const double step_deg = rows_deg[1] - rows_deg[0];
    EXPECT_NEAR(rows_deg.front() - 0.5 * step_deg, -7, 0.2);
    EXPECT_NEAR(rows_deg.back() + 0.5 * step_deg, 52, 0.2);
    for (std::size_t row = 1; row < rows_deg.size(); ++row) {
        EXPECT_NEAR(rows_deg[row] - rows_deg[row - 1], step_deg, 1e-4);
    }
}

TEST(RecoverBeams, HalfTurnKeepsResolution) {
    const Scan whole = randomScan(1, 20000, -7, 52);
    Scan half;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (whole.y_m[i] > 0) add({whole.x_m[i], whole.y_m[i], whole.z_m[i]}, half);
    }
    const auto of_whole = recoverBeams(whole), of_half = recoverBeams(half);
    EXPECT_NEAR(of_half->max_columns, of_whole->max_columns, 15);
    EXPECT_NEAR(of_half->sensor.rows(), of_whole->sensor.rows(), 3);
}

TEST(RecoverBeams, BlurredRingsGetFewRows) {
    // As returns are sparse in elevation, rows as fine as columns would be mostly empty.
    Spin blurred;
    blurred.columns = 1800;
    blurred.tilt_deg = 1.5;
    const auto found = recoverBeams(scanOf(beamsOf(sensorModel("VLP-16")), blurred));
    ASSERT_FALSE(found->sensor.has_rings);
    EXPECT_GE(found->sensor.rows(), 16);
    EXPECT_LE(found->sensor.rows(), 26);
}

TEST(RecoverBeams, AcceptsSingleElevation) {
    Scan scan;
    for (int i = 0; i < 500; ++i) add({1.0 + i, 0, 0}, scan);
    for (const double height_m : {0.0, 1.0}) {
        for (float& z_m : scan.z_m) z_m = static_cast<float>(1e6 * height_m);  // straight up
        const auto found = recoverBeams(scan);
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->sensor.has_rings);
        EXPECT_GE(found->sensor.rows(), 16);
        EXPECT_LE(found->sensor.elevations_rad.back(), static_cast<float>(radians(90.001)));
    }
}

/// The first scan of each folder in a set of real recordings.
std::vector<Scan> realScans(const std::string& set) {
    std::vector<Scan> scans;
    const char* const data = std::getenv("HAGEN_LABELLED_DATA");
    if (data == nullptr || !fs::is_directory(fs::path(data) / set)) return scans;
    std::set<fs::path> folders;
    for (const auto& folder : fs::directory_iterator(fs::path(data) / set)) folders.insert(folder);
    for (const fs::path& folder : folders) {
        std::set<fs::path> files;
        for (const auto& file : fs::directory_iterator(folder / "velodyne")) files.insert(file);
        std::ifstream in(*files.begin(), std::ios::binary);
        Scan& scan = scans.emplace_back();
        float point[4];
        while (in.read(reinterpret_cast<char*>(point), sizeof point)) {
            add({static_cast<double>(point[0]), static_cast<double>(point[1]),
                 static_cast<double>(point[2])},
                scan);
        }
    }
    return scans;
}

TEST(RecoverBeams, DeskewedRealScansHaveNoRings) {
    const auto coarse = realScans("beams16"), fine = realScans("beams64");
    if (coarse.empty() || fine.empty()) GTEST_SKIP() << "HAGEN_LABELLED_DATA is not set";
    for (const Scan& scan : coarse) {
        const auto found = recoverBeams(scan);
        EXPECT_FALSE(found->sensor.has_rings) << found->share;
        EXPECT_GE(found->sensor.rows(), 16);
        EXPECT_LE(found->sensor.rows(), 26);  // the sensor has 16 beams
    }
    for (const Scan& scan : fine) {
        const auto found = recoverBeams(scan);
        EXPECT_FALSE(found->sensor.has_rings) << found->share;
        EXPECT_GE(found->sensor.rows(), 35);
        EXPECT_LE(found->sensor.rows(), 80);  // the sensor has 64 beams
    }
}

// ---- rings

/// The rings of scanOf() without dropouts, in which beams repeat in order.
std::vector<std::int32_t> ringsOf(const Scan& scan, int beams) {
    std::vector<std::int32_t> rings;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        rings.push_back(static_cast<std::int32_t>(i % static_cast<std::size_t>(beams)));
    }
    return rings;
}

TEST(RingBeams, BeamIsRingMedian) {
    Spin spin;
    spin.columns = 200;
    spin.jitter_deg = 0.2;
    const std::vector<double> beams_deg{-7, -3, 0, 1.5, 8};
    const Scan scan = scanOf(beams_deg, spin);
    const auto found = ringBeams(scan, ringsOf(scan, 5));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->sensor.rows(), 5);
    for (std::size_t row = 0; row < 5; ++row) {
        EXPECT_NEAR(degrees(static_cast<double>(found->sensor.elevations_rad[row])), beams_deg[row],
                    0.1);
        EXPECT_EQ(found->row_of_ring[row], static_cast<int>(row));
    }
    EXPECT_EQ(found->sensor.name, kRecoveredName);
    EXPECT_NEAR(found->max_columns, 200, 2);
    EXPECT_GT(found->share, 0.99f);
}

TEST(RingBeams, RejectsNonRingFields) {
    const Scan scan = scanOf({-7, -3, 0, 1.5, 8}, {});
    const auto rings = ringsOf(scan, 5);
    ASSERT_TRUE(ringBeams(scan, rings));
    auto one = rings, two = rings, swapped = rings, blurred = rings, rare = rings;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        one[i] = 0;
        two[i] = rings[i] / 3;
        if (rings[i] == 1 || rings[i] == 2) swapped[i] = 3 - rings[i];
        if (i % 5 == 0 && i % 2 == 0) blurred[i] = 4;           // 10 % is tolerated
        if (i % 11 == 0) rare[i] = 1000 + static_cast<int>(i);  // rings with one return
    }
    EXPECT_FALSE(ringBeams(scan, one));
    EXPECT_FALSE(ringBeams(scan, two));
    EXPECT_FALSE(ringBeams(scan, swapped));
    EXPECT_TRUE(ringBeams(scan, blurred));
    EXPECT_FALSE(ringBeams(scan, rare));
    Spin few;
    few.columns = 79;
    const Scan small = scanOf({-7, -3, 0, 1.5, 8}, few);
    EXPECT_FALSE(ringBeams(small, ringsOf(small, 5)));
}

}  // namespace
}  // namespace hagen
