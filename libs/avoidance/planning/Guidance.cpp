#include <hagen/avoidance/Guidance.h>
#include <stdexcept>
#include "avoidance/planning/StraightWay.h"

namespace hagen::avoidance {
namespace {

constexpr double kNearGoal_m = 4;  ///< below this distance, the goal's own height applies
constexpr double kCarrot_m = 4, kNearestCarrot_m = 1;
constexpr double kEase_m = 0.05;
constexpr double kSight_m = 12;          ///< corners are cut up to this path length
constexpr double kCutClearance_m = 0.9;  ///< needed for cutting a corner
constexpr double kGoalSearch_m = 3;      ///< search radius for a replacement of a blocked goal
constexpr double kDetourHeightCost_per_m = 0.5;
constexpr double kHeuristicWeight = 1.3;  ///< saves 2/3 of the queries in dense forest
constexpr int kMaxCells = 20000;          ///< 4000 are too few past several rows of wires

/// The goal, at the target altitude while it is far, because the ground in between is unknown.
Eigen::Vector3d levelGoal(const GuidanceTask& task) {
    Eigen::Vector3d goal_m = task.goal_m;
    const double distance_m = (task.goal_m - task.position_m).head<2>().norm();
    if (distance_m > kNearGoal_m) goal_m.z() = task.ground_m + task.altitude_m;
    goal_m.z() =
        std::clamp(goal_m.z(), task.ground_m + task.lowest_m, task.ground_m + task.highest_m);
    return goal_m;
}

Carrot straightCarrot(const GuidanceTask& task) { return {levelGoal(task), {}, 0}; }

PathSearchOptions searchOptions(const GuidanceTask& task) {
    PathSearchOptions options;
    options.bounds_m = task.bounds_m;
    options.bounds_m.min().z() = task.ground_m + task.lowest_m;
    options.bounds_m.max().z() = task.ground_m + task.highest_m;
    options.min_clearance_m = task.limits.clearance_radius_m();
    options.wanted_height_m = task.ground_m + task.altitude_m;
    options.height_cost_per_m = kDetourHeightCost_per_m;
    options.anchor_m.z() = options.wanted_height_m;
    options.heuristic_weight = kHeuristicWeight;
    options.max_cells = kMaxCells;
    return options;
}

/// The goal, or, if blocked or out of bounds, the nearest free point on a grid around it.
Eigen::Vector3d freePlaceNear(const WorldModel& world, const Eigen::Vector3d& goal_m,
                              const PathSearchOptions& options) {
    const auto isFree = [&](const Eigen::Vector3d& at_m) {
        return world.clearance_m(at_m.cast<float>()) >= options.min_clearance_m;
    };
    Eigen::Vector3d inside_m =
        goal_m.cwiseMax(options.bounds_m.min()).cwiseMin(options.bounds_m.max());
    if (isFree(inside_m)) return inside_m;
    std::vector<Eigen::Vector3d> places_m;
    const int steps = static_cast<int>(kGoalSearch_m / options.cell_m);
    for (int z = -steps; z <= steps; ++z) {
        for (int y = -steps; y <= steps; ++y) {
            for (int x = -steps; x <= steps; ++x) {
                const Eigen::Vector3d at_m = inside_m + options.cell_m * Eigen::Vector3d(x, y, z);
                if (options.bounds_m.contains(at_m)) places_m.push_back(at_m);
            }
        }
    }
    std::stable_sort(places_m.begin(), places_m.end(), [&](const auto& a, const auto& b) {
        return (a - inside_m).squaredNorm() < (b - inside_m).squaredNorm();
    });
    const auto found = std::find_if(places_m.begin(), places_m.end(), isFree);
    return found != places_m.end() ? *found : inside_m;
}

bool isInSight(const WorldModel& world, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
               double min_m) {
    const auto clearance_m = [&](const Eigen::Vector3f& at_m) { return world.clearance_m(at_m); };
    return !blockedAt_m(clearance_m, from_m, to_m, min_m, 0.1);
}

/// The point at this distance along a path, or its end.
Eigen::Vector3d placeAt(const std::vector<Eigen::Vector3d>& path_m, double ahead_m) {
    for (std::size_t i = 1; i < path_m.size(); ++i) {
        const Eigen::Vector3d step_m = path_m[i] - path_m[i - 1];
        const double length_m = step_m.norm();
        if (length_m > ahead_m) return path_m[i - 1] + ahead_m / length_m * step_m;
        ahead_m -= length_m;
    }
    return path_m.back();
}

double lengthOf(const std::vector<Eigen::Vector3d>& path_m) {
    double length_m = 0;
    for (std::size_t i = 1; i < path_m.size(); ++i) length_m += (path_m[i] - path_m[i - 1]).norm();
    return length_m;
}

/// The maximum path distance of the carrot: planners fly straight, so no bend may hide it.
double carrotWay_m(const WorldModel& world, const std::vector<Eigen::Vector3d>& path_m,
                   double min_m) {
    double ahead_m = kCarrot_m;
    while (ahead_m > kNearestCarrot_m &&
           !isInSight(world, path_m.front(), placeAt(path_m, ahead_m), min_m)) {
        ahead_m -= 0.5;
    }
    return ahead_m;
}

/// Grid paths turn in steps of 45 degrees. The carrot lies on the straight line to a farther point
/// if that line has enough clearance.
Carrot carrotOn(const WorldModel& world, std::vector<Eigen::Vector3d> path_m,
                double clearance_radius_m) {
    const double length_m = lengthOf(path_m);
    const double carrot_m = carrotWay_m(world, path_m, clearance_radius_m);
    Carrot carrot{placeAt(path_m, carrot_m), {}, std::max(0.0, length_m - carrot_m)};
    for (double ahead_m = std::min(kSight_m, length_m); ahead_m > kCarrot_m; ahead_m -= 2) {
        const Eigen::Vector3d place_m = placeAt(path_m, ahead_m);
        if (!isInSight(world, path_m.front(), place_m, kCutClearance_m)) continue;
        const Eigen::Vector3d sight_m = place_m - path_m.front();
        const double distance_m = sight_m.norm();
        if (distance_m <= kCarrot_m) continue;
        carrot.at_m = path_m.front() + kCarrot_m / distance_m * sight_m;
        carrot.beyond_m = distance_m - kCarrot_m + length_m - ahead_m;
        break;
    }
    carrot.path_m = std::move(path_m);
    return carrot;
}

class StraightGuidance : public Guidance {
 public:
    Carrot carrot(const WorldModel&, const GuidanceTask& task) const override {
        return straightCarrot(task);
    }
};

class PathGuidance : public Guidance {
 public:
    Carrot carrot(const WorldModel& world, const GuidanceTask& task) const override {
        PathSearchOptions options = searchOptions(task);
        const Eigen::Vector3d goal_m = freePlaceNear(world, levelGoal(task), options);
        const auto limit_m = static_cast<float>(options.wanted_clearance_m);
        // Limited, because more clearance does not reduce the cost.
        const auto clearance_m = [&](const Eigen::Vector3f& point_m) {
            return world.clearanceWithin_m(point_m, limit_m);
        };
        // Searches first with extra clearance, which is easier to follow, then without.
        options.min_clearance_m += kEase_m;
        auto path_m = findPath(clearance_m, task.position_m, goal_m, options);
        if (!path_m) {
            options.min_clearance_m -= kEase_m;
            path_m = findPath(clearance_m, task.position_m, goal_m, options);
        }
        if (!path_m) return straightCarrot(task);
        return carrotOn(world, std::move(*path_m), task.limits.clearance_radius_m());
    }
};

}  // namespace

const std::vector<std::string>& guidanceNames() {
    static const std::vector<std::string> names{"straight", "astar"};
    return names;
}

std::unique_ptr<Guidance> makeGuidance(const std::string& name) {
    if (name == "straight") return std::make_unique<StraightGuidance>();
    if (name == "astar") return std::make_unique<PathGuidance>();
    throw std::invalid_argument("unknown guidance '" + name + "'; known: straight, astar");
}

}  // namespace hagen::avoidance
