#pragma once
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/Planner.h>
#include <cmath>
#include <deque>
#include <functional>
#include "support/SolidWorld.h"

namespace hagen::test {

/// A closed-loop flight through a known world with only planner and guidance, without sensor,
/// filter or maps.
struct SmallFlight {
    Eigen::Vector3d start_m{0, 0, 2}, goal_m{40, 0, 2};
    Eigen::AlignedBox3d bounds_m{Eigen::Vector3d(-5, -20, 0), Eigen::Vector3d(45, 20, 6)};
    std::string planner = "primitives", guidance = "straight";
    double speed_m_s = 4, latency_s = 0.1, longest_s = 60;
    double ground_m = 0;
    bool brakes_in_known_space = false;
    /// Called before each plan, to move the world.
    std::function<void(double time_s)> moves = [](double) {};
};

struct SmallFlightResult {
    bool arrived = false;
    double min_m = 1000, time_s = 0, path_m = 0;
    int plans = 0, emergencies = 0;
    long asked = 0;
    avoidance::VehicleState end;
};

/// Plans at 10 Hz from the state at which the command takes effect, and moves at 50 Hz. Ends within
/// 1 m of the goal or at the time limit.
inline SmallFlightResult fly(const SolidWorld& world, const SmallFlight& flight) {
    const auto planner = avoidance::makePlanner(flight.planner);
    const auto guidance = avoidance::makeGuidance(flight.guidance);
    const avoidance::VehicleLimits limits;
    const int delay = static_cast<int>(std::lround(flight.latency_s / avoidance::kControlStep_s));
    std::deque<Eigen::Vector3d> pending(static_cast<std::size_t>(delay), Eigen::Vector3d::Zero());
    SmallFlightResult result;
    avoidance::VehicleState state{flight.start_m, {0, 0, 0}};
    Eigen::Vector3d command_m_s(0, 0, 0);
    for (int step = 0; step * avoidance::kControlStep_s < flight.longest_s; ++step) {
        result.time_s = step * avoidance::kControlStep_s;
        if (step % 5 == 0) {
            flight.moves(result.time_s);
            avoidance::VehicleState then = state;
            for (const auto& sent : pending)
                then = avoidance::advance(then, sent, avoidance::kControlStep_s, limits);
            avoidance::GuidanceTask guided{
                state.position_m, flight.goal_m, flight.ground_m, 2, 1, 4.5,
                flight.bounds_m,  limits};
            const avoidance::Carrot carrot = guidance->carrot(world, guided);
            avoidance::PlanningTask task;
            task.start = then;
            task.carrot_m = carrot.at_m;
            task.beyond_carrot_m = carrot.beyond_m;
            task.speed_m_s = flight.speed_m_s;
            task.ground_m = flight.ground_m;
            task.brakes_in_known_space = flight.brakes_in_known_space;
            const avoidance::Plan plan = planner->plan(world, task);
            command_m_s = plan.command_m_s;
            ++result.plans;
            result.emergencies += plan.is_emergency;
        }
        pending.push_back(command_m_s);
        const avoidance::VehicleState next =
            avoidance::advance(state, pending.front(), avoidance::kControlStep_s, limits);
        pending.pop_front();
        result.path_m += (next.position_m - state.position_m).norm();
        state = next;
        result.min_m =
            std::min<double>(result.min_m, world.distance_m(state.position_m.cast<float>()));
        if ((state.position_m - flight.goal_m).norm() < 1) {
            result.arrived = true;
            break;
        }
    }
    result.asked = world.asked;
    result.end = state;
    return result;
}

/// Random trunks, at least 2 m from start and goal.
template <class RandomNumbers>
SolidWorld forest(RandomNumbers& random, double density_per_m2, const SmallFlight& flight,
                  float radius_m = 0.15f) {
    SolidWorld world;
    const Eigen::Vector3d size_m = flight.bounds_m.sizes();
    const int count = static_cast<int>(density_per_m2 * size_m.x() * size_m.y());
    for (int i = 0; i < count; ++i) {
        const float x = random.real(static_cast<float>(flight.bounds_m.min().x()),
                                    static_cast<float>(flight.bounds_m.max().x()));
        const float y = random.real(static_cast<float>(flight.bounds_m.min().y()),
                                    static_cast<float>(flight.bounds_m.max().y()));
        const Eigen::Vector2f at(x, y);
        if ((at - flight.start_m.head<2>().cast<float>()).norm() < 2 ||
            (at - flight.goal_m.head<2>().cast<float>()).norm() < 2) {
            continue;
        }
        world.trunk(at, radius_m);
    }
    return world.ground(0);
}

}  // namespace hagen::test
