#include "avoidance/planning/Motion.h"
#include <algorithm>
#include <cmath>

namespace hagen::avoidance {
namespace {

constexpr double kStanding_m_s = 0.05;
constexpr float kCheckStep_m = 0.08f;
constexpr double kApproachShare = 0.4;  ///< fraction of the acceleration used to stop
constexpr double kMinApproach_m_s = 0.5;

}  // namespace

void rollOut(const VehicleState& start, const Eigen::Vector3d& command_m_s, double hold_s,
             const VehicleLimits& limits, std::vector<Eigen::Vector3f>& path_m) {
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    VehicleState state = start;
    path_m.clear();
    path_m.push_back(state.position_m.cast<float>());
    const int held = static_cast<int>(std::ceil(hold_s / kControlStep_s - 1e-9));
    for (int step = 0; step < held || state.velocity_m_s.norm() > kStanding_m_s; ++step) {
        state = advance(state, step < held ? command_m_s : none, kControlStep_s, limits);
        path_m.push_back(state.position_m.cast<float>());
    }
}

std::optional<float> freeClearance(const WorldModel& world,
                                   const std::vector<Eigen::Vector3f>& path_m, double start_after_s,
                                   double clearance_radius_m) {
    const float approach_m = world.fastest_m_s() * static_cast<float>(kControlStep_s);
    float min_m = WorldModel::kReach_m, needed_m = 0, free_m = 0;
    for (std::size_t i = 0; i < path_m.size(); ++i) {
        // Points within the sphere of the last clearance need no query.
        if (i > 0) free_m -= (path_m[i] - path_m[i - 1]).norm() + approach_m;
        if (free_m > 0) continue;
        const double after_s = start_after_s + kControlStep_s * static_cast<double>(i);
        const float clearance_m = world.clearanceAfter_m(path_m[i], after_s);
        if (clearance_m < needed_m) return std::nullopt;
        const auto room = static_cast<float>(clearance_radius_m);
        needed_m = clearance_m >= room ? room : clearance_m;
        min_m = std::min(min_m, clearance_m);
        free_m = std::max(clearance_m - needed_m, kCheckStep_m);
    }
    return min_m;
}

float minClearance_m(const WorldModel& world, const std::vector<Eigen::Vector3f>& path_m,
                     double start_after_s) {
    const float approach_m = world.fastest_m_s() * static_cast<float>(kControlStep_s);
    float min_m = WorldModel::kReach_m, spare_m = 0;  // margin above the minimum so far
    for (std::size_t i = 0; i < path_m.size(); ++i) {
        if (i > 0) spare_m -= (path_m[i] - path_m[i - 1]).norm() + approach_m;
        if (spare_m > 0) continue;
        const double after_s = start_after_s + kControlStep_s * static_cast<double>(i);
        const float clearance_m = world.clearanceAfter_m(path_m[i], after_s);
        min_m = std::min(min_m, clearance_m);
        spare_m = std::max(clearance_m - min_m, kCheckStep_m);
    }
    return min_m;
}

std::optional<float> checkCommand(const WorldModel& world, const PlanningTask& task,
                                  const Eigen::Vector3d& command_m_s, double hold_s,
                                  CommandPaths& paths) {
    const std::vector<Eigen::Vector3f>&path_m = paths.held_m, &broken_off_m = paths.broken_off_m;
    rollOut(task.start, command_m_s, task.period_s, task.limits, paths.broken_off_m);
    rollOut(task.start, command_m_s, hold_s, task.limits, paths.held_m);
    if (task.brakes_in_known_space &&
        !(world.isKnown(broken_off_m.back()) && world.isKnown(path_m.back()))) {
        return std::nullopt;
    }
    const std::optional<float> soon_m =
        freeClearance(world, broken_off_m, task.start_after_s, task.limits.clearance_radius_m());
    if (!soon_m) return std::nullopt;
    const std::optional<float> later_m =
        freeClearance(world, path_m, task.start_after_s, task.limits.clearance_radius_m());
    if (!later_m) return std::nullopt;
    const bool is_near = *later_m < static_cast<float>(task.limits.clearance_radius_m());
    const double end_s =
        task.start_after_s + kControlStep_s * static_cast<double>(path_m.size() - 1);
    if (is_near && !(world.clearanceAfter_m(path_m.back(), end_s) > *later_m)) return std::nullopt;
    return std::min(*soon_m, *later_m);
}

double speedTowardsGoal(const PlanningTask& task) {
    const double distance_m = (task.carrot_m - task.start.position_m).norm() + task.beyond_carrot_m;
    const double stopping_m_s =
        std::sqrt(2 * kApproachShare * task.limits.acceleration_m_s2 * distance_m);
    return std::min(task.speed_m_s, std::max(kMinApproach_m_s, stopping_m_s));
}

double outOfAltitudes(double height_m, const PlanningTask& task) {
    const double altitude_m = height_m - task.ground_m;
    return std::max({0.0, task.lowest_m - altitude_m, altitude_m - task.highest_m});
}

bool mustStop(const WorldModel& world, const PlanningTask& task) {
    std::vector<Eigen::Vector3f> path_m;
    rollOut(task.start, task.start.velocity_m_s, task.period_s, task.limits, path_m);
    return !freeClearance(world, path_m, task.start_after_s, task.limits.radius_m);
}

}  // namespace hagen::avoidance
