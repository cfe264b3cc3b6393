#include <algorithm>
#include <cmath>
#include <limits>
#include "avoidance/planning/Motion.h"
#include "avoidance/planning/Planners.h"

namespace hagen::avoidance {
namespace {

constexpr double kCell_rad = 6 * M_PI / 180;
constexpr int kAzimuths = 60, kMaxRow = 3;  ///< elevations of -18 to 18 degrees
constexpr float kTraceStep_m = 0.1f;
constexpr double kReaction_s = 0.3;  ///< reaction time in addition to the stopping distance
constexpr double kHold_s = 0.4;      ///< time before braking in the check
constexpr double kSlowest_m_s = 0.3;

// Cost weights of angles in radians and of the blocked fraction.
constexpr double kTargetCost = 1.0, kChangeCost = 0.25;
constexpr double kBlockedCost = 1.5;
constexpr double kOpen_m = 2.5, kShutCost = 4;  ///< cost of a shorter free distance

struct HistogramCell {
    double cost;  ///< excludes the blocked fraction, which needs queries
    Eigen::Vector3d direction;
};

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The range of cells: stopping distance from full speed plus the look-ahead.
double lookAhead(const PlanningTask& task) {
    const double speed_m_s = task.speed_m_s;
    return speed_m_s * speed_m_s / (2 * task.limits.acceleration_m_s2) + kLookAhead_s * speed_m_s +
           1;
}

/// The free distance of a sphere of the clearance radius that moves at the speed towards the goal.
double freeDistance(const WorldModel& world, const PlanningTask& task,
                    const Eigen::Vector3d& direction, double reach_m) {
    const auto clearance_radius_m = static_cast<float>(task.limits.clearance_radius_m());
    const auto speed_m_s = static_cast<float>(speedTowardsGoal(task));
    // Approaching objects shorten the distance for which a clearance is valid.
    const float share = speed_m_s / (speed_m_s + world.fastest_m_s());
    float at_m = 0, needed_m = 0;
    while (at_m < reach_m) {
        const Eigen::Vector3d point_m = task.start.position_m + at_m * direction;
        const double after_s = task.start_after_s + static_cast<double>(at_m / speed_m_s);
        const float clearance_m = world.clearanceAfter_m(point_m.cast<float>(), after_s);
        if (clearance_m < needed_m) return at_m;
        needed_m = clearance_m >= clearance_radius_m ? clearance_radius_m
                                                     : std::max(needed_m, clearance_m);
        at_m += std::max((clearance_m - needed_m) * share, kTraceStep_m);
    }
    return reach_m;
}

/// The maximum speed for stopping within a distance.
double speedFor(double free_m, const PlanningTask& task) {
    const double a = task.limits.acceleration_m_s2;
    return a * (std::sqrt(kReaction_s * kReaction_s + 2 * free_m / a) - kReaction_s);
}

/// The cost of a direction blocked before the end of the range.
double blockedCost(const PlanningTask& task, double free_m, double reach_m) {
    const double goal_m = (task.carrot_m - task.start.position_m).norm() + task.beyond_carrot_m;
    const bool is_shut = free_m < std::min(kOpen_m, goal_m);
    return kBlockedCost * (1 - free_m / reach_m) + (is_shut ? kShutCost : 0);
}

double directionCost(const PlanningTask& task, const Eigen::Vector3d& target,
                     const Eigen::Vector3d& direction) {
    const double reach_m = kLookAhead_s * speedTowardsGoal(task);
    const double end_m = task.start.position_m.z() + reach_m * direction.z();
    const double speed_m_s = task.start.velocity_m_s.norm();
    const double change_rad =
        speed_m_s > 0.1 ? angleBetween(direction, task.start.velocity_m_s) : 0.0;
    return kTargetCost * angleBetween(direction, target) +
           kChangeCost * std::min(1.0, speed_m_s / task.speed_m_s) * change_rad +
           kHeightCost_per_m * std::abs(end_m - task.carrot_m.z()) +
           kOutOfAltitudesCost_per_m * outOfAltitudes(end_m, task);
}

/// Rows and columns of the histogram are relative to the carrot's direction. The vehicle should
/// reach the target height within the look-ahead, however far the carrot is.
std::vector<HistogramCell> rankedCells(const PlanningTask& task) {
    const Eigen::Vector3d offset_m = task.carrot_m - task.start.position_m;
    const double heading_rad = std::atan2(offset_m.y(), offset_m.x());
    const double level_m =
        std::min(offset_m.head<2>().norm(), kLookAhead_s * speedTowardsGoal(task));
    const double climb_rad = std::clamp(std::atan2(offset_m.z(), std::max(level_m, 1e-3)),
                                        -kMaxRow * kCell_rad, kMaxRow * kCell_rad);
    const auto towards = [](double azimuth_rad, double elevation_rad) {
        return Eigen::Vector3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                               std::cos(elevation_rad) * std::sin(azimuth_rad),
                               std::sin(elevation_rad));
    };
    const Eigen::Vector3d target = towards(heading_rad, climb_rad);
    std::vector<HistogramCell> cells;
    for (int column = 0; column < kAzimuths; ++column) {
        for (int row = -kMaxRow; row <= kMaxRow; ++row) {
            const double elevation_rad = row == 0 ? climb_rad : row * kCell_rad;
            const Eigen::Vector3d direction =
                towards(heading_rad + column * kCell_rad, elevation_rad);
            cells.push_back({directionCost(task, target, direction), direction});
        }
    }
    std::stable_sort(
        cells.begin(), cells.end(),
        [](const HistogramCell& a, const HistogramCell& b) { return a.cost < b.cost; });
    return cells;
}

/// The fastest command in a direction that passes the check; empty if none passes.
std::optional<Eigen::Vector3d> commandAlong(const WorldModel& world, const PlanningTask& task,
                                            const HistogramCell& cell, double free_m,
                                            CommandPaths& paths, Plan& plan) {
    double speed_m_s = std::min(speedTowardsGoal(task), speedFor(free_m, task));
    for (int attempt = 0; attempt < 2 && speed_m_s >= kSlowest_m_s; ++attempt) {
        const Eigen::Vector3d command_m_s = speed_m_s * cell.direction;
        const bool is_free = checkCommand(world, task, command_m_s, kHold_s, paths).has_value();
        if (task.keeps_candidates) plan.candidates.push_back({paths.held_m, command_m_s, is_free});
        if (is_free) return command_m_s;
        speed_m_s /= 2;
    }
    return std::nullopt;
}

}  // namespace

Plan PolarHistogram::plan(const WorldModel& world, const PlanningTask& task) const {
    Plan plan;
    plan.is_emergency = true;
    if (mustStop(world, task)) return plan;
    const double reach_m = lookAhead(task);
    CommandPaths paths;
    double best = std::numeric_limits<double>::infinity();
    for (const HistogramCell& cell : rankedCells(task)) {
        if (cell.cost >= best) break;  // all others cost more, regardless of free distance
        const double free_m = freeDistance(world, task, cell.direction, reach_m);
        const double cost = cell.cost + blockedCost(task, free_m, reach_m);
        if (cost >= best) continue;
        if (const auto command_m_s = commandAlong(world, task, cell, free_m, paths, plan)) {
            best = cost;
            plan.command_m_s = *command_m_s;
            plan.is_emergency = false;
        }
    }
    return plan;
}

}  // namespace hagen::avoidance
