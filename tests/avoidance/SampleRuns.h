#pragma once
#include <cmath>

#include "avoidance/flights/RunTable.h"

namespace hagen::test {

using Row = hagen::avoidance::Run;  // testing::Test has a member Run()

inline Row runOf(const std::string& scenario, std::uint64_t seed, const std::string& model,
                 const std::string& guidance, hagen::avoidance::Outcome outcome,
                 double speed_m_s = 4) {
    Row run{};
    run.scenario = scenario;
    run.seed = seed;
    run.setup.model = model;
    run.setup.guidance = guidance;
    run.setup.speed_m_s = speed_m_s;
    run.result = {outcome, 0.1 * static_cast<double>(seed % 10),
                  44,      12,
                  NAN,     20,
                  100,     5,
                  2,       4,
                  6,       static_cast<double>(seed)};
    run.oracle_path_m = 40;
    run.settings_hash = "a";
    run.version = "1";
    return run;
}

inline constexpr auto kWon = hagen::avoidance::Outcome::Success,
                      kHit = hagen::avoidance::Outcome::Collision,
                      kLate = hagen::avoidance::Outcome::Timeout;

/// Seeds 0..9: W-RoI fails 0 (collision), O-Full-0.4 0 to 2 (timeout), W-RoI straight all.
inline std::vector<Row> threeContenders() {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", seed == 0 ? kHit : kWon));
        runs.push_back(runOf("gap", seed, "O-Full-0.4", "astar", seed < 3 ? kLate : kWon));
        runs.push_back(runOf("gap", seed, "W-RoI", "straight", kLate));
    }
    return runs;
}

}  // namespace hagen::test
