#include <gtest/gtest.h>
#include <hagen/avoidance/PathSearch.h>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "support/Random.h"
#include "support/SolidWorld.h"

namespace hagen::avoidance {
namespace {

using test::SolidWorld;
using Path = std::vector<Eigen::Vector3d>;

PathSearchOptions within(const Eigen::Vector3d& min_m, const Eigen::Vector3d& max_m) {
    PathSearchOptions options;
    options.bounds_m = {min_m, max_m};
    return options;
}

std::optional<Path> search(const SolidWorld& world, const Eigen::Vector3d& start_m,
                           const Eigen::Vector3d& goal_m, const PathSearchOptions& options) {
    return findPath([&](const Eigen::Vector3f& at) { return world.clearance_m(at); }, start_m,
                    goal_m, options);
}

double lengthOf(const Path& path_m) {
    double length_m = 0;
    for (std::size_t i = 1; i < path_m.size(); ++i) length_m += (path_m[i] - path_m[i - 1]).norm();
    return length_m;
}

/// The minimum clearance along the path, in steps of 1 cm.
double minClearance(const SolidWorld& world, const Path& path_m) {
    double min_m = WorldModel::kReach_m;
    for (std::size_t i = 1; i < path_m.size(); ++i) {
        const Eigen::Vector3d offset_m = path_m[i] - path_m[i - 1];
        for (double at = 0; at <= 1; at += 0.01 / offset_m.norm()) {
            min_m = std::min<double>(
                min_m, world.clearance_m((path_m[i - 1] + at * offset_m).cast<float>()));
        }
    }
    return min_m;
}

TEST(PathSearch, CrossesEmptySpaceStraight) {
    const PathSearchOptions options = within({-1, -20, 0}, {50, 20, 5});
    const auto straight = search({}, {0, 0, 2}, {40, 0, 2}, options);
    ASSERT_TRUE(straight);
    EXPECT_NEAR(lengthOf(*straight), 40, 1e-9);
    const auto diagonal = search({}, {0, 0, 2}, {40, 12, 4}, options);
    ASSERT_TRUE(diagonal);
    const double octile_m = 28 + (12 - 2) * std::sqrt(2.0) + 2 * std::sqrt(3.0);
    EXPECT_NEAR(lengthOf(*diagonal), octile_m, 1e-9);
    EXPECT_EQ(diagonal->front(), Eigen::Vector3d(0, 0, 2));
    EXPECT_EQ(diagonal->back(), Eigen::Vector3d(40, 12, 4));
}

TEST(PathSearch, QueriesFewCellsInEmptySpace) {
    const SolidWorld world;
    search(world, {0, 0, 2}, {40, 7, 2}, within({-1, -20, 0}, {50, 20, 5}));
    EXPECT_LT(world.asked, 200);
}

/// A wall across the path with a single gap centred at `middle_m`.
SolidWorld wallWithGap(float middle_m, float width_m) {
    SolidWorld world;
    world.box({9.9f, -30, -10}, {10.1f, middle_m - width_m / 2, 20});
    world.box({9.9f, middle_m + width_m / 2, -10}, {10.1f, 30, 20});
    return world;
}

TEST(PathSearch, FindsWideGapAnywhere) {
    const PathSearchOptions options = within({-1, -10, 0}, {20, 10, 4});
    for (float middle_m = -2; middle_m < 2; middle_m += 0.07f) {
        const SolidWorld world = wallWithGap(middle_m, 1.6f);
        const auto path = search(world, {0, 0, 2}, {20, 0, 2}, options);
        ASSERT_TRUE(path) << middle_m;
        EXPECT_GT(minClearance(world, *path), options.min_clearance_m - 0.1) << middle_m;
    }
}

TEST(PathSearch, AvoidsNarrowGap) {
    const PathSearchOptions options = within({-1, -10, 0}, {20, 10, 4});
    for (float middle_m = -2; middle_m < 2; middle_m += 0.35f) {
        EXPECT_FALSE(search(wallWithGap(middle_m, 1.19f), {0, 0, 2}, {20, 0, 2}, options));
    }
}

TEST(PathSearch, DetectsThinWallBetweenCells) {
    SolidWorld world;
    world.box({9.74f, -30, -10}, {9.76f, 30, 20});
    PathSearchOptions options = within({-1, -10, 0}, {20, 10, 4});
    options.min_clearance_m = 0.1;
    EXPECT_FALSE(search(world, {0, 0, 2}, {20, 0, 2}, options));
}

TEST(PathSearch, FindsNoPathToBlockedGoal) {
    const PathSearchOptions options = within({-1, -10, 0}, {20, 10, 4});
    SolidWorld cage;
    cage.box({8, -3, -9}, {8.1f, 3, 9}).box({14, -3, -9}, {14.1f, 3, 9});
    cage.box({8, -3, -9}, {14, -2.9f, 9}).box({8, 2.9f, -9}, {14, 3, 9});
    EXPECT_FALSE(search(cage, {0, 0, 2}, {11, 0, 2}, options));
    EXPECT_TRUE(search(cage, {0, 0, 2}, {18, 0, 2}, options));
    EXPECT_FALSE(search(SolidWorld().sphere({11, 0, 2}, 1), {0, 0, 2}, {11, 0, 2}, options));
    EXPECT_FALSE(search({}, {0, 0, 2}, {21, 0, 2}, options));
}

TEST(PathSearch, StopsAtCellLimit) {
    PathSearchOptions options = within({-1, -10, 0}, {20, 10, 4});
    options.max_cells = 10;
    EXPECT_FALSE(search({}, {0, 0, 2}, {20, 0, 2}, options));
}

TEST(PathSearch, LeavesObstacleAtStart) {
    const PathSearchOptions options = within({-5, -10, 0}, {20, 10, 4});
    const SolidWorld world = SolidWorld().box({0.3f, -4, -9}, {0.5f, 4, 9});
    const auto path = search(world, {0, 0, 2}, {10, 0, 2}, options);
    ASSERT_TRUE(path);
    double before_m = 0.29;
    for (const Eigen::Vector3d& at : *path) {  // rises to the minimum and stays above
        const double clearance_m = world.clearance_m(at.cast<float>());
        EXPECT_TRUE(clearance_m > before_m || clearance_m >= options.min_clearance_m - 1e-6);
        before_m = std::min(clearance_m, options.min_clearance_m);
    }
    EXPECT_GT(lengthOf(*path), 12);
}

TEST(PathSearch, PrefersWantedClearance) {
    const SolidWorld world = SolidWorld().trunk({10, 0}, 0.3f);
    const auto path = search(world, {0, 0, 2}, {20, 0, 2}, within({-1, -10, 2}, {21, 10, 2}));
    ASSERT_TRUE(path);
    EXPECT_GT(minClearance(world, *path), 0.9);
    EXPECT_LT(lengthOf(*path), 22);
}

TEST(PathSearch, HeightCostPreventsClimbing) {
    const SolidWorld world = SolidWorld().box({9, -3, 0}, {10, 3, 2.6f});
    PathSearchOptions options = within({-1, -10, 0}, {21, 10, 5});
    const auto heights = [&] {
        double max_m = 0;
        const auto path = search(world, {0, 0, 2}, {20, 0, 2}, options);
        for (const Eigen::Vector3d& at : path.value()) max_m = std::max(max_m, at.z());
        return max_m;
    };
    EXPECT_GT(heights(), 3);
    options.wanted_height_m = 2;
    options.height_cost_per_m = 2;
    EXPECT_EQ(heights(), 2);
}

TEST(PathSearch, RejectsInvalidGrids) {
    EXPECT_THROW(search({}, {0, 0, 2}, {1, 0, 2}, PathSearchOptions{}), std::invalid_argument);
    PathSearchOptions options = within({0, 0, 0}, {1, 1, 1});
    options.cell_m = 0;
    EXPECT_THROW(search({}, {0, 0, 0}, {1, 0, 0}, options), std::invalid_argument);
    EXPECT_THROW(search({}, {0, 0, 0}, {1, 0, 0}, within({0, 0, 0}, {1e6, 1e6, 1e6})),
                 std::invalid_argument);
}

/// Plain Dijkstra search on the same graph, which visits every cell and tries every step.
class PlainGraph {
 public:
    PlainGraph(const SolidWorld& world, const Eigen::Vector3d& start_m,
               const Eigen::Vector3d& goal_m, const PathSearchOptions& options)
        : world_(world), start_m_(start_m), goal_m_(goal_m), options_(options) {}

    using Key = std::tuple<int, int, int>;

    Eigen::Vector3d pointOf(const Key& key) const {
        const Eigen::Vector3d middle_m =
            0.5 * Eigen::Vector3d(std::get<0>(key), std::get<1>(key), std::get<2>(key));
        if ((middle_m - start_m_).norm() < 1e-9 || (middle_m - goal_m_).norm() < 1e-9) {
            return middle_m;
        }
        Eigen::Vector3d best_m = middle_m;
        if (clearance(middle_m) >= options_.min_clearance_m ||
            clearance(middle_m) + 0.125 * std::sqrt(2.0) < options_.min_clearance_m) {
            return best_m;
        }
        for (double y : {-0.125, 0.125}) {
            for (double x : {0.125, -0.125}) {
                const Eigen::Vector3d there_m = middle_m + Eigen::Vector3d(x, y, 0);
                if (clearance(there_m) > clearance(best_m)) best_m = there_m;
            }
        }
        return best_m;
    }
    double clearance(const Eigen::Vector3d& at) const {
        return world_.clearance_m(at.cast<float>());
    }
    double extra(const Eigen::Vector3d& at) const {
        return 2 * std::clamp((options_.wanted_clearance_m - clearance(at)) /
                                  (options_.wanted_clearance_m - options_.min_clearance_m),
                              0.0, 1.0);
    }
    double stepCost(const Key& a, const Key& b) const {
        const Eigen::Vector3d difference(std::get<0>(a) - std::get<0>(b),
                                         std::get<1>(a) - std::get<1>(b),
                                         std::get<2>(a) - std::get<2>(b));
        return 0.5 * difference.norm() * (1 + (extra(pointOf(a)) + extra(pointOf(b))) / 2);
    }
    bool mayPass(const Key& a, const Key& b) const {
        const Eigen::Vector3d from_m = pointOf(a), to_m = pointOf(b);
        const double min_m = options_.min_clearance_m;
        if (clearance(to_m) < min_m || clearance(from_m) < min_m) return false;
        return minClearance(world_, {from_m, to_m}) >= min_m - 0.05;
    }

    /// Infinite if there is no path.
    double cost() const {
        const auto keyOf = [](const Eigen::Vector3d& at) {
            return Key(std::lround(2 * at.x()), std::lround(2 * at.y()), std::lround(2 * at.z()));
        };
        std::map<Key, double> best{{keyOf(start_m_), 0}};
        std::set<std::pair<double, Key>> open{{0, keyOf(start_m_)}};
        while (!open.empty()) {
            const auto [cost, key] = *open.begin();
            open.erase(open.begin());
            if (key == keyOf(goal_m_)) return cost;
            if (cost > best.at(key)) continue;
            for (int i = 0; i < 27; ++i) {
                const Key next(std::get<0>(key) + i % 3 - 1, std::get<1>(key) + i / 3 % 3 - 1,
                               std::get<2>(key) + i / 9 - 1);
                const Eigen::Vector3d middle_m =
                    0.5 * Eigen::Vector3d(std::get<0>(next), std::get<1>(next), std::get<2>(next));
                if (next == key || !options_.bounds_m.contains(middle_m)) continue;
                const double there = cost + stepCost(key, next);
                const auto known = best.find(next);
                if ((known != best.end() && known->second <= there) || !mayPass(key, next))
                    continue;
                best[next] = there;
                open.insert({there, next});
            }
        }
        return std::numeric_limits<double>::infinity();
    }

 private:
    const SolidWorld& world_;
    Eigen::Vector3d start_m_, goal_m_;
    const PathSearchOptions& options_;
};

TEST(PathSearch, CostMatchesDijkstra) {
    const PathSearchOptions options = within({0, 0, 0}, {8, 5, 2});
    int found = 0, none = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        test::Random random(seed);
        SolidWorld world;
        for (unsigned i = 0; i < 10 + 5 * seed; ++i) {
            const float x = random.real(1.5f, 6.5f), y = random.real(0, 5), z = random.real(0, 2);
            world.sphere({x, y, z}, random.real(0.1f, 0.5f));
        }
        const Eigen::Vector3d start_m(0, 2.5, 1), goal_m(8, 2.5, 1);
        const auto path = search(world, start_m, goal_m, options);
        const PlainGraph graph(world, start_m, goal_m, options);
        const double cost = graph.cost();
        ASSERT_EQ(path.has_value(), std::isfinite(cost)) << seed;
        ++(path ? found : none);
        if (!path) continue;
        double path_cost = 0;
        for (std::size_t i = 1; i < path->size(); ++i) {
            const auto keyOf = [](const Eigen::Vector3d& at) {
                return PlainGraph::Key(std::lround(2 * at.x()), std::lround(2 * at.y()),
                                       std::lround(2 * at.z()));
            };
            path_cost += graph.stepCost(keyOf((*path)[i - 1]), keyOf((*path)[i]));
        }
        EXPECT_NEAR(path_cost, cost, 0.002 * cost) << seed;
    }
    EXPECT_GT(found, 2);
    EXPECT_GT(none, 0);
}

}  // namespace
}  // namespace hagen::avoidance
