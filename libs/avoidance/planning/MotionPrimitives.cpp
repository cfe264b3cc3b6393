#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include "avoidance/planning/Motion.h"
#include "avoidance/planning/Planners.h"

namespace hagen::avoidance {
namespace {

constexpr int kHeadings = 36;
constexpr double kSteepest_rad = 0.24;
constexpr std::array<double, 4> kSpeedShares{1.0, 0.6, 0.3, 0.1};
constexpr double kVertical_m_s = 1.0;
constexpr double kAtGoal_m = 0.5;

// Cost weights, relative to progress at full speed straight to the carrot.
constexpr double kDeviationCost = 0.2;
constexpr double kCommandChangeCost = 0.1;
constexpr double kStandingCost = 0.3;  ///< cost of hovering away from the goal
constexpr double kProximityCost = 0.25, kComfortable_m = 1.3;

struct Candidate {
    double cost;  ///< excludes proximity, which needs queries
    Eigen::Vector3d command_m_s;
};

/// The target of the candidates: the carrot, or a point beyond it if the path continues, so that
/// the vehicle does not slow down at the carrot.
Eigen::Vector3d aimOf(const PlanningTask& task) {
    const Eigen::Vector3d offset_m = task.carrot_m - task.start.position_m;
    const double length_m = offset_m.norm();
    const double reach_m =
        std::min(task.speed_m_s * kLookAhead_s + 1, length_m + task.beyond_carrot_m);
    if (length_m < 1e-6 || length_m >= reach_m) return task.carrot_m;
    Eigen::Vector3d aim_m = task.start.position_m + reach_m / length_m * offset_m;
    aim_m.z() = task.carrot_m.z();
    return aim_m;
}

/// The target height should be reached within the look-ahead time, however far the carrot is.
std::array<double, 5> elevationsTo(const Eigen::Vector3d& aim_m, const PlanningTask& task,
                                   double speed_m_s) {
    const Eigen::Vector3d offset_m = aim_m - task.start.position_m;
    const double level_m = std::min(offset_m.head<2>().norm(), speed_m_s * kLookAhead_s);
    const double exact_rad = std::atan2(offset_m.z(), std::max(level_m, 1e-3));
    return {std::clamp(exact_rad, -kSteepest_rad, kSteepest_rad), -kSteepest_rad,
            -kSteepest_rad / 2, kSteepest_rad / 2, kSteepest_rad};
}

std::vector<Eigen::Vector3d> commandsFor(const PlanningTask& task, const Eigen::Vector3d& aim_m) {
    const Eigen::Vector3d offset_m = aim_m - task.start.position_m;
    const double heading_rad = std::atan2(offset_m.y(), offset_m.x());
    const double speed_m_s = speedTowardsGoal(task);
    const std::array<double, 5> elevations_rad = elevationsTo(aim_m, task, speed_m_s);
    std::vector<Eigen::Vector3d> commands_m_s{{0, 0, 0}};
    commands_m_s.reserve(kHeadings * elevations_rad.size() * kSpeedShares.size() + 3);
    for (double vertical_m_s : {kVertical_m_s, -kVertical_m_s}) {
        commands_m_s.emplace_back(0, 0, std::min(task.speed_m_s, kVertical_m_s) * vertical_m_s);
    }
    for (int azimuth = 0; azimuth < kHeadings; ++azimuth) {
        const double azimuth_rad = heading_rad + azimuth * 2 * M_PI / kHeadings;
        for (double elevation_rad : elevations_rad) {
            const double level = std::cos(elevation_rad);
            const Eigen::Vector3d direction(level * std::cos(azimuth_rad),
                                            level * std::sin(azimuth_rad), std::sin(elevation_rad));
            for (double share : kSpeedShares) {
                commands_m_s.push_back(share * speed_m_s * direction);
            }
        }
    }
    return commands_m_s;
}

/// End of a command within the look-ahead time, in coarse steps, which suffice for ranking.
Eigen::Vector3d endOf(const PlanningTask& task, const Eigen::Vector3d& command_m_s) {
    constexpr double kStep_s = 0.1;
    VehicleState state = task.start;
    for (int step = 0; step < static_cast<int>(kLookAhead_s / kStep_s + 0.5); ++step) {
        state = advance(state, command_m_s, kStep_s, task.limits);
    }
    return state.position_m;
}

double commandCost(const PlanningTask& task, const Eigen::Vector3d& aim_m,
                   const Eigen::Vector3d& command_m_s) {
    const Eigen::Vector3d end_m = endOf(task, command_m_s);
    const Eigen::Vector3d offset_m = (aim_m - task.start.position_m);
    const Eigen::Vector2d flown_m = (end_m - task.start.position_m).head<2>();
    const double reach_m = task.speed_m_s * kLookAhead_s;
    const double progress =
        (offset_m.head<2>().norm() - (aim_m - end_m).head<2>().norm()) / reach_m;
    const Eigen::Vector2d ahead = offset_m.head<2>().normalized();
    const double deviation = std::abs(ahead.x() * flown_m.y() - ahead.y() * flown_m.x()) / reach_m;
    const double change = (command_m_s - task.start.velocity_m_s).norm() / task.speed_m_s;
    const bool stands = command_m_s.isZero() && offset_m.norm() > kAtGoal_m;
    return (stands ? kStandingCost : 0) - progress + kDeviationCost * deviation +
           kHeightCost_per_m * std::abs(end_m.z() - aim_m.z()) +
           kOutOfAltitudesCost_per_m * outOfAltitudes(end_m.z(), task) +
           kCommandChangeCost * change;
}

std::vector<Candidate> rankedCandidates(const PlanningTask& task) {
    const Eigen::Vector3d aim_m = aimOf(task);
    std::vector<Candidate> candidates;
    for (const Eigen::Vector3d& command_m_s : commandsFor(task, aim_m)) {
        candidates.push_back({commandCost(task, aim_m, command_m_s), command_m_s});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    return candidates;
}

double proximityCost(double clearance_m, const VehicleLimits& limits) {
    const double short_m = kComfortable_m - clearance_m;
    return kProximityCost *
           std::clamp(short_m / (kComfortable_m - limits.clearance_radius_m()), 0.0, 1.0);
}

/// The cheapest free command, or an emergency.
Plan cheapestFree(const WorldModel& world, const PlanningTask& task) {
    Plan plan;
    plan.is_emergency = true;
    if (mustStop(world, task)) return plan;
    double best = std::numeric_limits<double>::infinity();
    CommandPaths paths;
    for (const Candidate& candidate : rankedCandidates(task)) {
        if (candidate.cost >= best) break;  // all others cost more, regardless of clearance
        const std::optional<float> clearance_m =
            checkCommand(world, task, candidate.command_m_s, kLookAhead_s, paths);
        if (task.keeps_candidates) {
            plan.candidates.push_back(
                {paths.held_m, candidate.command_m_s, clearance_m.has_value()});
        }
        if (!clearance_m) continue;
        const double cost = candidate.cost + proximityCost(*clearance_m, task.limits);
        if (cost < best) {
            best = cost;
            plan.command_m_s = candidate.command_m_s;
            plan.is_emergency = false;
        }
    }
    return plan;
}

/// Whether an obstacle comes too close even if the vehicle brakes.
bool isBrakingUnsafe(const WorldModel& world, const PlanningTask& task) {
    std::vector<Eigen::Vector3f> path_m;
    rollOut(task.start, Eigen::Vector3d::Zero(), kLookAhead_s, task.limits, path_m);
    return static_cast<double>(minClearance_m(world, path_m, task.start_after_s)) <
           task.limits.radius_m;
}

/// Stopping is not safe among moving obstacles. If no command is free, chooses the one with the
/// largest clearance (then the lowest cost) within the altitude limits, at full speed even near the
/// goal.
Eigen::Vector3d evadingCommand(const WorldModel& world, PlanningTask task) {
    constexpr double kFarOff_m = 1000;
    task.beyond_carrot_m += kFarOff_m;
    float best_m = -1;
    Eigen::Vector3d best_m_s = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3f> path_m;
    for (const Candidate& candidate : rankedCandidates(task)) {
        rollOut(task.start, candidate.command_m_s, kLookAhead_s, task.limits, path_m);
        const auto end_m = static_cast<double>(path_m.back().z());
        if (outOfAltitudes(end_m, task) > outOfAltitudes(task.start.position_m.z(), task)) continue;
        if (task.brakes_in_known_space && !world.isKnown(path_m.back())) continue;
        const float clearance_m = minClearance_m(world, path_m, task.start_after_s);
        if (clearance_m > best_m) {
            best_m = clearance_m;
            best_m_s = candidate.command_m_s;
        }
    }
    return best_m_s;
}

}  // namespace

Plan MotionPrimitives::plan(const WorldModel& world, const PlanningTask& task) const {
    Plan plan = cheapestFree(world, task);
    if (plan.is_emergency && world.fastest_m_s() > 0 && isBrakingUnsafe(world, task)) {
        plan.command_m_s = evadingCommand(world, task);
    }
    return plan;
}

}  // namespace hagen::avoidance
