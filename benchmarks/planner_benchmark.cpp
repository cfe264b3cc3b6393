// Flies planners in closed loop through random forests in which every tree is known: success,
// minimum distance, planning cost. Trunks have a radius of 0.15 m; the goal is 40 m away.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/Random.h"
#include "support/SmallFlight.h"

namespace {

using namespace hagen;

double cpu_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

struct Sum {
    int arrived = 0, collided = 0, plans = 0, emergencies = 0;
    double time_s = 0, path_m = 0, min_m = 1000, cpu_us = 0;
    long asked = 0;
};

Sum flyForests(test::SmallFlight flight, double density_per_m2, int seeds) {
    Sum sum;
    for (int seed = 0; seed < seeds; ++seed) {
        test::Random random(static_cast<unsigned>(seed));
        const test::SolidWorld world = test::forest(random, density_per_m2, flight);
        const double before_us = cpu_us();
        const test::SmallFlightResult flown = test::fly(world, flight);
        sum.cpu_us += cpu_us() - before_us;
        const bool collided = flown.min_m < avoidance::VehicleLimits{}.collision_m;
        sum.collided += collided;
        sum.plans += flown.plans;
        sum.emergencies += flown.emergencies;
        sum.asked += flown.asked;
        sum.min_m = std::min(sum.min_m, flown.min_m);
        if (collided || !flown.arrived) continue;
        ++sum.arrived;
        sum.time_s += flown.time_s;
        sum.path_m += flown.path_m;
    }
    return sum;
}

}  // namespace

int main(int arguments, char** argument) {
    const int seeds = arguments > 1 ? std::atoi(argument[1]) : 100;
    std::printf(
        "planner    guidance trees/m2  m/s  arrived  collided    min m  time s  path m  "
        "emergencies/km    queries/plan  us/plan\n");
    for (const std::string& planner : avoidance::plannerNames()) {
        for (const std::string& guidance : avoidance::guidanceNames()) {
            for (double density_per_m2 : {0.02, 0.05, 0.1}) {
                for (double speed_m_s : {4.0, 6.0, 8.0}) {
                    test::SmallFlight flight;
                    flight.planner = planner;
                    flight.guidance = guidance;
                    flight.speed_m_s = speed_m_s;
                    const Sum sum = flyForests(flight, density_per_m2, seeds);
                    const double arrived = std::max(1, sum.arrived);
                    std::printf(
                        "%-10s %-8s %8.2f %4.0f %8d %9d %8.2f %7.1f %7.1f %15.1f %15.0f %8.0f\n",
                        planner.c_str(), guidance.c_str(), density_per_m2, speed_m_s, sum.arrived,
                        sum.collided, sum.min_m, sum.time_s / arrived, sum.path_m / arrived,
                        1000.0 * sum.emergencies / std::max(1.0, sum.path_m),
                        static_cast<double>(sum.asked) / sum.plans, sum.cpu_us / sum.plans);
                    std::fflush(stdout);
                }
            }
        }
    }
}
