#include "avoidance/openloop/LaterScansTruth.h"
#include <gtest/gtest.h>
#include <hagen/simulation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hagen::avoidance {
namespace {

/// Returns from every direction at this range, or from the wall x = 5 if it is nearer.
observations::MappedScan everywhere(const Eigen::Vector3f& origin_m, float range_m, bool has_wall) {
    observations::MappedScan scan;
    scan.origin_m = origin_m;
    for (int azimuth_deg = 0; azimuth_deg < 360; ++azimuth_deg) {
        for (int elevation_deg = -40; elevation_deg <= 40; ++elevation_deg) {
            const float azimuth = static_cast<float>(azimuth_deg * M_PI / 180);
            const float elevation = static_cast<float>(elevation_deg * M_PI / 180);
            const Eigen::Vector3f ray(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
            float range = range_m;
            if (has_wall && ray.x() > 1e-3f) {
                range = std::min(range, (5 - origin_m.x()) / ray.x());
            }
            scan.points_m.push_back(origin_m + range * ray);
        }
    }
    scan.labels.assign(scan.points_m.size(), Label::Rou);
    return scan;
}

TrueDirections truthOf(const observations::MappedScan& scan,
                       const Eigen::Vector3f& position_m = {0, 0, 2}) {
    LaterScansTruth truth(position_m);
    truth.see(scan.points_m, SeenRanges(scan));
    return truth.directions();
}

TEST(LaterScansTruth, NeedsLaterScans) {
    EXPECT_TRUE(LaterScansTruth({0, 0, 2}).directions().scored.none());
    EXPECT_TRUE(truthOf(observations::MappedScan()).blocked.none());
}

TEST(LaterScansTruth, SeenSpaceIsFree) {
    const auto truth = truthOf(everywhere({0.5f, 0, 2}, 20, false));
    EXPECT_TRUE(truth.scored.all());
    EXPECT_TRUE(truth.blocked.none());
}

TEST(SeenRanges, IgnoresPointAtOrigin) {
    observations::MappedScan scan = everywhere({0.5f, 0, 2}, 20, false);
    scan.points_m.insert(scan.points_m.begin(), scan.origin_m);
    const SeenRanges seen(scan);
    EXPECT_TRUE(seen.isSeenThrough({15, 3, 2}));
    EXPECT_FALSE(seen.isSeenThrough({25, 3, 2}));
}

TEST(LaterScansTruth, ScoresOnlyFullySeenDirections) {
    // The paths are shorter and longer than the range of 6 m; no returns are near them.
    LaterScansTruth short_way({0, 0, 2}, {5.0f, 0.65f}), long_way({0, 0, 2}, {6.9f, 0.2f});
    observations::MappedScan scan = everywhere({0, 0, 2}, 6, false);
    scan.points_m.erase(std::remove_if(scan.points_m.begin(), scan.points_m.end(),
                                       [](const auto& p) { return std::abs(p.z() - 2) < 2.5f; }),
                        scan.points_m.end());
    short_way.see(scan.points_m, SeenRanges(scan));
    EXPECT_TRUE(short_way.directions().scored.none());
    long_way.see(scan.points_m, SeenRanges(scan));
    EXPECT_TRUE(long_way.directions().scored.none());
}

TEST(LaterScansTruth, TwoPointsBlockDirection) {
    observations::MappedScan scan = everywhere({0.5f, 0, 2}, 20, false);
    scan.points_m.push_back({4, 0, 2});
    EXPECT_FALSE(truthOf(scan).blocked[120]);  // horizontal, along x
    EXPECT_FALSE(truthOf(scan).scored[120]);
    scan.points_m.push_back({4, 0, 2});
    EXPECT_TRUE(truthOf(scan).blocked[120]);
}

TEST(PersistentPoints, RequireEarlierNearbyPoint) {
    PersistentPoints points;
    observations::MappedScan scan;
    scan.points_m = {{1, 2, 3}, {-4, 5, -6}, {13, 0, 0}};
    EXPECT_TRUE(points.of(observations::MappedScan()).empty());
    EXPECT_TRUE(points.of(scan).empty());
    scan.points_m = {{1.1f, 1.9f, 3.05f}, {-4, 5, -7}, {13, 0, 0}};
    EXPECT_EQ(points.of(scan), (std::vector<Eigen::Vector3f>{{1.1f, 1.9f, 3.05f}}));
    for (int i = 0; i < 4; ++i) points.of(observations::MappedScan());
    EXPECT_EQ(points.of(scan).size(), 2u);  // first seen five scans ago; 13 m is out of range
    for (int i = 0; i < 5; ++i) points.of(observations::MappedScan());
    EXPECT_TRUE(points.of(scan).empty());
}

TEST(LaterScansTruth, MatchesBruteForce) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        simulation::Random random(seed);
        observations::MappedScan scan;
        scan.origin_m = {100, 0, 0};
        for (int i = 0; i < 60; ++i) {
            Eigen::Vector3f p;
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = static_cast<float>(random.uniform(-1, 1) * (axis == 2 ? 3 : 10));
            }
            if (i < 2) p *= 0.05f;  // near the origin
            scan.points_m.push_back(p);
        }
        if (seed > 5) scan.points_m.erase(scan.points_m.begin(), scan.points_m.begin() + 2);
        const auto truth = truthOf(scan, {0, 0, 0});
        for (std::size_t n = 0; n < kDirections; ++n) {
            int points = 0;
            for (const auto& p : scan.points_m) {
                float min_m = std::numeric_limits<float>::infinity();
                for (float distance_m = 0; distance_m <= 8; distance_m += 0.04f) {
                    min_m = std::min(min_m, (p - distance_m * directionOf(n)).norm());
                }
                if (std::abs(min_m - 0.65f) < 0.001f) points = 100;  // within rounding errors
                points += min_m < 0.65f;
            }
            if (points >= 100) continue;
            EXPECT_EQ(truth.blocked[n], points >= 2) << seed << " " << n;
        }
    }
}

}  // namespace
}  // namespace hagen::avoidance
