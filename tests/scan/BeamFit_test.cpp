#include "scan/BeamFit.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RecoverBeams.h>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

/// A turn of these beams with random ranges and elevation errors of up to `jitter_deg`.
Scan scanOfBeams(const std::vector<double>& beams_deg, float jitter_deg = 0.0f, unsigned seed = 1) {
    test::Random random(seed);
    Scan scan;
    for (int column = 0; column < 600; ++column) {
        for (const double beam_deg : beams_deg) {
            const double elevation_deg =
                beam_deg + static_cast<double>(random.real(-jitter_deg, jitter_deg));
            const Eigen::Vector3d point_m =
                static_cast<double>(random.real(2, 60)) *
                test::directionOf(kPi - 2 * kPi * (column + 0.5) / 600, radians(elevation_deg));
            scan.x_m.push_back(static_cast<float>(point_m.x()));
            scan.y_m.push_back(static_cast<float>(point_m.y()));
            scan.z_m.push_back(static_cast<float>(point_m.z()));
        }
    }
    return scan;
}

std::vector<double> beamsEvery(double step_deg, double lowest_deg, double highest_deg) {
    std::vector<double> beams_deg;
    for (double beam_deg = lowest_deg; beam_deg <= highest_deg + 1e-9; beam_deg += step_deg) {
        beams_deg.push_back(beam_deg);
    }
    return beams_deg;
}

TEST(BeamFit, KnownModelsFitOwnBeams) {
    for (const std::string& name : knownSensorModels()) {
        SCOPED_TRACE(name);
        const SensorModel sensor = sensorModel(name);
        std::vector<double> beams_deg;
        for (const float beam_rad : sensor.elevations_rad) {
            beams_deg.push_back(degrees(static_cast<double>(beam_rad)));
        }
        const auto fit = fitBeams(scanOfBeams(beams_deg), sensor, 600);
        ASSERT_EQ(fit.has_value(), sensor.has_rings);
        if (!fit) continue;
        EXPECT_EQ(fit->returns, 600 * beams_deg.size());
        EXPECT_EQ(fit->beams, beams_deg.size());
        EXPECT_EQ(fit->beams_seen, beams_deg.size());
        EXPECT_EQ(fit->share(), 1.0f);
        EXPECT_EQ(fit->filled, 1.0f);
    }
}

TEST(BeamFit, FewerBeamsLeaveRowsEmpty) {
    // The scan has 16 blurred beams; the model's 64 beams are so dense that all returns fit.
    const auto beams_deg = beamsEvery(2, -15, 15);
    const auto fit =
        fitBeams(scanOfBeams(beams_deg, 1.0f), customSensorModel(beamsEvery(0.5, -16, 16.5)), 600);
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->share(), 0.99f);
    EXPECT_NEAR(fit->filled, 0.25, 0.05);  // one return per four rows
    // With the true beams, every row has returns.
    EXPECT_GT(fitBeams(scanOfBeams(beams_deg, 0.5f), sensorModel("VLP-16"), 600)->filled, 0.99f);
}

TEST(BeamFit, CountsReturnsWithinTolerance) {
    // With uniform jitter of 0.8 degrees, half of the returns are within 0.4 degrees.
    const auto fit =
        fitBeams(scanOfBeams(beamsEvery(2, -15, 15), 0.8f), sensorModel("VLP-16"), 600);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->returns_share, 0.5, 0.02);
}

TEST(BeamFit, ShiftedBeamsDoNotFit) {
    const auto fit = fitBeams(scanOfBeams(beamsEvery(2, -14, 16)), sensorModel("VLP-16"), 600);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->returns_share, 0.0f);
    EXPECT_EQ(fit->beams_seen, 0u);
    EXPECT_EQ(fit->beams_shown, 16u);
    EXPECT_EQ(fit->share(), 0.0f);
}

TEST(BeamFit, ReportsWrongBeamCount) {
    const std::vector<double> half_deg = beamsEvery(4, -15, 15);
    const auto fewer = fitBeams(scanOfBeams(half_deg), sensorModel("VLP-16"), 600);
    ASSERT_TRUE(fewer);
    EXPECT_EQ(fewer->returns_share, 1.0f);
    EXPECT_EQ(fewer->beams_seen, 8u);
    EXPECT_EQ(fewer->beams, 15u);  // from -15 to 13 degrees
    EXPECT_FLOAT_EQ(fewer->share(), 8.0f / 15.0f);

    const auto more =
        fitBeams(scanOfBeams(beamsEvery(2, -15, 15)), customSensorModel(half_deg), 600);
    ASSERT_TRUE(more);
    EXPECT_EQ(more->beams_shown, 16u);
    EXPECT_EQ(more->beams_seen, 8u);
    EXPECT_FLOAT_EQ(more->share(), 0.5f);
}

TEST(BeamFit, IgnoresBeamsInSky) {
    const auto fit = fitBeams(scanOfBeams(beamsEvery(2, -15, 1)), sensorModel("VLP-16"), 600);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->beams, 9u);
    EXPECT_EQ(fit->share(), 1.0f);
}

TEST(BeamFit, CountsReturnsWithoutBeams) {
    const auto fit = fitBeams(scanOfBeams(beamsEvery(0.05, -15, 15)), sensorModel("VLP-16"), 600);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->beams_shown, 0u);
    EXPECT_NEAR(fit->share(), 0.4, 0.03);  // 0.8 of 2 degrees
}

TEST(BeamFit, NeedsEnoughReturns) {
    Scan scan = scanOfBeams({-15, 0, 15});
    scan.x_m.resize(kMinReturnsForBeams);
    scan.y_m.resize(kMinReturnsForBeams);
    scan.z_m.resize(kMinReturnsForBeams);
    EXPECT_TRUE(fitBeams(scan, sensorModel("VLP-16"), 600));
    scan.x_m.back() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(fitBeams(scan, sensorModel("VLP-16"), 600));
}

}  // namespace
}  // namespace hagen
