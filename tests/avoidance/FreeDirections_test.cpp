#include <gtest/gtest.h>
#include <hagen/avoidance/FreeDirections.h>
#include <hagen/simulation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hagen::avoidance {
namespace {

using Points = std::vector<Eigen::Vector3f>;

float nearest(const Points& points_m, const Eigen::Vector3f& to_m) {
    float min_m = 3.0f;  // range of world models
    for (const auto& point_m : points_m) min_m = std::min(min_m, (point_m - to_m).norm());
    return min_m;
}

/// Distance from a point to the path in a direction.
float distanceToPath(const Eigen::Vector3f& point_m, const Eigen::Vector3f& direction,
                     float length_m) {
    const float along_m = std::clamp(point_m.dot(direction), 0.0f, length_m);
    return (point_m - along_m * direction).norm();
}

TEST(FreeDirections, AreUnitVectors) {
    EXPECT_NEAR((directionOf(120) - Eigen::Vector3f::UnitX()).norm(), 0, 1e-6);
    EXPECT_NEAR((directionOf(135) - Eigen::Vector3f::UnitY()).norm(), 0, 1e-6);
    EXPECT_NEAR(std::asin(directionOf(0).z()), -0.24f, 1e-6);
    EXPECT_NEAR(std::asin(directionOf(299).z()), 0.24f, 1e-6);
    for (std::size_t n = 0; n < kDirections; ++n) {
        EXPECT_NEAR(directionOf(n).norm(), 1, 1e-6);
        EXPECT_EQ(pointsDown(n), directionOf(n).z() < -1e-3f);
    }
}

/// Touching an obstacle does not block the sphere.
TEST(FreeDirections, TouchingIsFree) {
    const FreeDirectionOptions options;
    const auto leave_m = [&](float room_m) { return [room_m](const auto&) { return room_m; }; };
    const float radius_m = options.clearance_radius_m;
    EXPECT_TRUE(blockedDirections(leave_m(radius_m), {0, 0, 0}, options).none());
    EXPECT_TRUE(
        blockedDirections(leave_m(std::nextafter(radius_m, 0.0f)), {0, 0, 0}, options).all());
}

TEST(FreeDirections, MatchBruteForce) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        simulation::Random random(seed);
        Points points_m(30);
        for (auto& point_m : points_m) {
            for (int axis = 0; axis < 3; ++axis) {
                point_m[axis] = static_cast<float>(random.uniform() * (axis == 2 ? 4 : 20) -
                                                   (axis == 2 ? 2 : 10));
            }
        }
        const auto blocked =
            blockedDirections([&](const auto& p) { return nearest(points_m, p); }, {0, 0, 0});
        for (std::size_t n = 0; n < kDirections; ++n) {
            float min_m = std::numeric_limits<float>::infinity();
            for (const auto& p : points_m) {
                min_m = std::min(min_m, distanceToPath(p, directionOf(n), 8.0f));
            }
            // A minimum step may skip an obstacle that the sphere only grazes.
            if (std::abs(min_m - 0.65f) > 0.002f) {
                EXPECT_EQ(blocked[n], min_m < 0.65f) << seed << " " << n;
            }
        }
    }
}

TEST(FreeDirections, AgreementCountsFreeDirections) {
    DirectionSet a, b;
    a.set();
    b.set();
    EXPECT_EQ(freeAgreement(a, b), 1);
    for (const std::size_t n : {0u, 1u, 2u, 3u}) a.reset(n);  // free: 0 1 2 3
    EXPECT_EQ(freeAgreement(a, b), 0);
    for (const std::size_t n : {2u, 3u, 4u}) b.reset(n);  // free: 2 3 4
    EXPECT_DOUBLE_EQ(freeAgreement(a, b), 2.0 / 5);
    EXPECT_DOUBLE_EQ(freeAgreement(b, a), 2.0 / 5);
    EXPECT_EQ(freeAgreement(a, a), 1);
}

TEST(FreeDirections, CountsOnlyScoredDirections) {
    DirectionSet said, truth, scored;
    for (const std::size_t n : {1u, 2u, 3u, 9u}) said.set(n);
    for (const std::size_t n : {2u, 3u, 4u, 5u, 8u}) truth.set(n);
    for (std::size_t n = 0; n < 8; ++n) scored.set(n);
    DirectionCounts counts = countBlocked(said, truth, scored);
    EXPECT_EQ(counts.scored, 8u);
    EXPECT_EQ(counts.hits, 2u);
    EXPECT_EQ(counts.false_alarms, 1u);
    EXPECT_EQ(counts.misses, 2u);
    EXPECT_DOUBLE_EQ(counts.precision(), 2.0 / 3);
    EXPECT_DOUBLE_EQ(counts.recall(), 0.5);
    counts += countBlocked(truth, truth, scored);
    EXPECT_EQ(counts.hits, 6u);
    EXPECT_TRUE(std::isnan(countBlocked({}, {}, scored).precision()));
    EXPECT_TRUE(std::isnan(countBlocked({}, {}, scored).recall()));
}

}  // namespace
}  // namespace hagen::avoidance
