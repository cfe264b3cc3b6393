#include <gtest/gtest.h>
#include <hagen/evaluation/DroneScores.h>
#include <cmath>
#include <stdexcept>

#include "evaluation/Labels.h"
#include "support/PointScan.h"
#include "support/Random.h"

namespace hagen::evaluation {
namespace {

using Eigen::Vector3f;

constexpr float kGround_m = -2;

GroundTruthScan scanOf(const std::vector<Vector3f>& points_m, const std::vector<Label>& truth) {
    GroundTruthScan scan;
    scan.input.scan = test::scanOf(sensorModel("VLP-16"), points_m);
    scan.truth = truth;
    return scan;
}

DroneScores scoresOf(const GroundTruthScan& scan, const std::vector<Label>& found,
                     const LabelMap& kinds = {}) {
    return DroneTruth(scan, {}).score(found, kinds);
}

TEST(DroneScores, CountMissedReturnsAboveHalfMetre) {
    const auto scan = scanOf({{4, 0, kGround_m},
                              {4, 0.2f, -1.55f},
                              {4, 0.2f, -1.45f},
                              {4, 0.2f, 0},
                              {12, 0, 0},
                              {30, 0, 0}},
                             {G, O, O, O, O, O});
    const DroneScores scores = scoresOf(scan, {G, G, G, O, U, G});
    EXPECT_EQ(scores.tall.all, 3);
    EXPECT_EQ(scores.tall.missed, 2);
    EXPECT_NEAR(scores.tall.share(), 2 / 3.0, 1e-12);
    ASSERT_EQ(scores.tall_by_range.size(), 4u);
    EXPECT_EQ(scores.tall_by_range[0].missed, 1);
    EXPECT_EQ(scores.tall_by_range[0].all, 2);
    EXPECT_EQ(scores.tall_by_range[2].missed, 1);
}

TEST(DroneScores, CountUnknownHeightsAsTall) {
    const DroneScores scores = scoresOf(scanOf({{4, 0, -1}}, {O}), {G});
    EXPECT_EQ(scores.tall.missed, 1);
}

TEST(DroneScores, PreferGivenHeights) {
    auto scan = scanOf({{4, 0, kGround_m}, {4, 0, 0}, {4, 0, -1.9f}, {30, 0, 0}, {4, 1, 0}},
                       {G, O, O, O, U});
    scan.heights_m = {9, 0.4f, 0.6f, 9, 9};  // used for obstacles in range only
    EXPECT_EQ(scoresOf(scan, {G, G, G, G, G}).tall.all, 1);
    scan.heights_m.pop_back();
    EXPECT_THROW(scoresOf(scan, {G, G, G, G, G}), std::invalid_argument);
}

TEST(DroneScores, SumMissedReturnsByClass) {
    auto scan = scanOf({{4, 0, kGround_m}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}}, {G, O, O, O});
    scan.kinds = {1, 4, 4, 9};
    const LabelMap kinds{{1, {"soil", G}}, {4, {"pole", O}}, {9, {"wire", O}}};
    const DroneScores scores = scoresOf(scan, {G, O, G, G}, kinds);
    ASSERT_EQ(scores.tall_by_kind.size(), 2u);
    EXPECT_EQ(scores.tall_by_kind.at("pole").missed, 1);
    EXPECT_EQ(scores.tall_by_kind.at("pole").all, 2);
    EXPECT_EQ(scores.tall_by_kind.at("wire").missed, 1);
}

TEST(DroneScores, FindObstaclesByOneReturn) {
    std::vector<Vector3f> points_m{{4, 0, kGround_m}};
    std::vector<Label> truth{G}, found{O};
    GroundTruthScan scan;
    std::vector<std::uint32_t> objects{1};  // number of the ground, ignored
    const auto add = [&](std::uint32_t object, float x_m, int returns, int roi) {
        for (int i = 0; i < returns; ++i) {
            points_m.push_back({x_m, 0, 0});
            truth.push_back(O);
            found.push_back(i < roi ? O : G);
            objects.push_back(object);
        }
    };
    add(1, 5, 5, 1);
    add(2, 6, 5, 0);
    add(3, 7, 4, 0);   // too few returns
    add(4, 25, 9, 0);  // too far
    add(0, 8, 9, 0);   // no number
    scan = scanOf(points_m, truth);
    EXPECT_EQ(scoresOf(scan, found).obstacles.all, 0);
    scan.objects = objects;
    const DroneScores scores = scoresOf(scan, found);
    EXPECT_EQ(scores.obstacles.all, 2);
    EXPECT_EQ(scores.obstacles.missed, 1);
}

TEST(DroneScores, CountFalseRoiOnBareGround) {
    test::Random random(3);
    std::vector<Vector3f> points_m;
    std::vector<Label> truth, found;
    for (int i = 0; i < 400; ++i) {
        points_m.push_back({random.real(-25, 25), random.real(-25, 25), kGround_m});
        const bool is_obstacle = random.chance(0.1);
        if (is_obstacle) points_m.back().z() = random.real(-1, 3);
        truth.push_back(is_obstacle ? O : random.chance(0.1) ? U : G);
        found.push_back(random.chance(0.5) ? O : G);
    }
    const auto scan = scanOf(points_m, truth);
    std::int64_t expected = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        bool is_bare = truth[i] == G && found[i] == O && points_m[i].norm() <= 20;
        for (std::size_t k = 0; k < truth.size(); ++k) {
            const float distance_m = (points_m[k] - points_m[i]).head<2>().norm();
            is_bare = is_bare && !(truth[k] == O && distance_m < 2);
        }
        expected += is_bare;
    }
    EXPECT_GT(expected, 10);
    EXPECT_EQ(scoresOf(scan, found).false_on_bare_ground, expected);
}

TEST(DroneScores, SumOverScans) {
    auto scan = scanOf({{4, 0, kGround_m}, {4, 0, 0}, {15, 0, kGround_m}}, {G, O, G});
    scan.kinds = {1, 4, 1};
    const LabelMap kinds{{1, {"soil", G}}, {4, {"pole", O}}};
    DroneScores sum;
    EXPECT_TRUE(std::isnan(sum.falseOnBareGroundPerScan()));
    EXPECT_TRUE(std::isnan(sum.tall.share()));
    sum += scoresOf(scan, {G, G, O}, kinds);
    sum += scoresOf(scan, {G, O, G}, kinds);
    EXPECT_EQ(sum.scans, 2u);
    EXPECT_EQ(sum.tall.missed, 1);
    EXPECT_EQ(sum.tall.all, 2);
    EXPECT_EQ(sum.tall_by_range[0].all, 2);
    EXPECT_EQ(sum.tall_by_kind.at("pole").all, 2);
    EXPECT_EQ(sum.falseOnBareGroundPerScan(), 0.5);
}

TEST(DroneScores, RejectWrongSizes) {
    auto scan = scanOf({{4, 0, 0}}, {O});
    EXPECT_THROW(scoresOf(scan, {O, O}), std::invalid_argument);
    scan.objects = {1, 2};
    EXPECT_THROW(scoresOf(scan, {O}), std::invalid_argument);
    scan.objects.clear();
    scan.truth.clear();
    EXPECT_THROW(scoresOf(scan, {O}), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::evaluation
