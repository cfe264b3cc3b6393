#include "evaluation/TrueHeights.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/Labels.h"
#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen::evaluation {
namespace {

using Eigen::Vector3f;

GroundTruthScan truthOf(const std::vector<Vector3f>& points_m, const std::vector<Label>& truth) {
    GroundTruthScan scan;
    scan.input.scan = test::scanOf(sensorModel("VLP-16"), points_m);
    scan.truth = truth;
    return scan;
}

std::vector<float> heightsOf(const GroundTruthScan& scan, float max_range_m = 100) {
    return heightsAboveTrueGround(scan, levelPoints(scan), max_range_m);
}

float plainMedian(std::vector<float> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The definition, implemented directly over all cells and distances.
float plainHeight(const GroundTruthScan& scan, std::size_t obstacle) {
    const auto centre = [&](std::size_t i) {
        return Eigen::Vector2f(0.5f * std::floor(2 * scan.input.scan.x_m[i]) + 0.25f,
                               0.5f * std::floor(2 * scan.input.scan.y_m[i]) + 0.25f);
    };
    struct Ground {
        Eigen::Vector2f centre_m;
        std::vector<float> z_m;
    };
    std::vector<Ground> cells;
    for (std::size_t i = 0; i < scan.truth.size(); ++i) {
        if (scan.truth[i] != G) continue;
        const auto same = std::find_if(cells.begin(), cells.end(), [&](const Ground& cell) {
            return cell.centre_m == centre(i);
        });
        if (same == cells.end()) {
            cells.push_back({centre(i), {scan.input.scan.z_m[i]}});
        } else {
            same->z_m.push_back(scan.input.scan.z_m[i]);
        }
    }
    const auto distance = [&](const Ground& cell) {
        return (cell.centre_m - centre(obstacle)).norm();
    };
    std::vector<float> near_m;
    for (const Ground& cell : cells) {
        if (distance(cell) <= 3.0f) near_m.push_back(plainMedian(cell.z_m));
    }
    if (near_m.empty()) {
        std::sort(cells.begin(), cells.end(),
                  [&](const Ground& a, const Ground& b) { return distance(a) < distance(b); });
        const float last_m = distance(cells[std::min<std::size_t>(20, cells.size()) - 1]);
        for (const Ground& cell : cells) {
            if (distance(cell) <= last_m + 1e-4f) near_m.push_back(plainMedian(cell.z_m));
        }
    }
    return scan.input.scan.z_m[obstacle] - plainMedian(near_m);
}

TEST(TrueHeights, UseNearbyTrueGround) {
    const auto scan = truthOf({{4, 0, -2.0f}, {5, 1, -2.1f}, {5, 0, -1.0f}, {60, 0, 7}, {5, 1, -1}},
                              {G, G, O, G, U});
    const std::vector<float> heights_m = heightsOf(scan);
    EXPECT_FLOAT_EQ(heights_m[2], 1.0f);  // above the upper of two medians
    for (const std::size_t i : {0, 1, 3, 4}) EXPECT_TRUE(std::isnan(heights_m[i])) << i;
}

TEST(TrueHeights, MatchBruteForce) {
    test::Random random(7);
    std::size_t by_nearest = 0;
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::vector<Vector3f> points_m;
        std::vector<Label> truth;
        for (int i = 0; i < 300; ++i) {
            points_m.push_back({random.real(-15, 15), random.real(-4, 4), random.real(-3, 3)});
            truth.push_back(points_m.back().x() > 6 || random.chance(0.3) ? O : G);
        }
        const auto scan = truthOf(points_m, truth);
        const std::vector<float> heights_m = heightsOf(scan);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] != O) continue;
            EXPECT_FLOAT_EQ(heights_m[i], plainHeight(scan, i)) << repetition << " " << i;
            by_nearest += points_m[i].x() > 10;
        }
    }
    EXPECT_GT(by_nearest, 100u);
}

TEST(TrueHeights, AreInfiniteWithoutGround) {
    EXPECT_EQ(heightsOf(truthOf({{5, 0, -1}}, {O}))[0], std::numeric_limits<float>::infinity());
    EXPECT_TRUE(heightsOf(truthOf({}, {})).empty());
}

/// Squared distances this large are integers as floats.
TEST(TrueHeights, UseDistantGround) {
    for (const float far_m : {1000.0f, 1500.0f, 2000.0f, 5000.0f, 9999.0f}) {
        const auto heights = heightsOf(truthOf({{far_m, 0, -1}, {10, 0, 0}}, {G, O}));
        EXPECT_NEAR(heights[1], 1, 1e-5) << far_m;
    }
}

TEST(TrueHeights, SkipReturnsBeyondRange) {
    const auto scan = truthOf({{4, 0, -2}, {5, 0, 0}, {7, 0, 0}}, {G, O, O});
    const std::vector<float> heights_m = heightsOf(scan, 6);
    EXPECT_FLOAT_EQ(heights_m[1], 2.0f);
    EXPECT_TRUE(std::isnan(heights_m[2]));
}

// Very distant returns have no cell; sanitizers would report the overflow of a cell index.
TEST(TrueHeights, SkipImplausiblyFarReturns) {
    const auto scan = truthOf({{4, 0, -2}, {5, 0, 0}, {20000, 0, 0}, {20000, 0, -2}}, {G, O, O, G});
    const std::vector<float> heights_m = heightsOf(scan, 1e6f);
    EXPECT_FLOAT_EQ(heights_m[1], 2.0f);
    EXPECT_TRUE(std::isnan(heights_m[2]));
}

// A tilted sensor whose attitude is unknown, known, or known only to the scorer.
TEST(TrueHeights, UseTrueHorizonOfTiltedSensor) {
    const std::vector<Vector3f> points_m{{4, 1, -2}, {4.2f, 1.1f, -2}, {4, 1, -1.2f}};
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(radians(30)), Vector3f::UnitX()).toRotationMatrix();
    std::vector<Vector3f> tilted_m;
    for (const Vector3f& point_m : points_m) tilted_m.push_back(turn.transpose() * point_m);
    auto scan = truthOf(tilted_m, {G, G, O});
    EXPECT_GT(std::abs(heightsOf(scan)[2] - 0.8f), 0.05f);
    scan.input.map_from_sensor = turn;
    EXPECT_NEAR(heightsOf(scan)[2], 0.8f, 1e-5f);
    scan.true_level_from_sensor = turn;
    scan.input.map_from_sensor.reset();
    EXPECT_NEAR(heightsOf(scan)[2], 0.8f, 1e-5f);
}

TEST(TrueHeights, IgnoreNonFiniteReturns) {
    auto scan =
        truthOf({{4, 0, -2}, {std::nanf(""), 0, -1}, {3e8f, 0, 0}, {5, 0, 0}}, {G, G, G, O});
    EXPECT_FLOAT_EQ(heightsOf(scan)[3], 2.0f);
}

}  // namespace
}  // namespace hagen::evaluation
