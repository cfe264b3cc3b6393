#pragma once
#include <hagen/trials/RunTable.h>
#include <string>
#include <tuple>

namespace hagen::trials {

/// What runs have in common that are compared with one another: all but scenario, model, guidance.
struct Condition {
    double speed_m_s;
    std::string planner;
    PoseError pose_error;
    double latency_scale;
    bool brakes_in_known_space;

    auto key() const {
        return std::tie(speed_m_s, planner, pose_error, latency_scale, brakes_in_known_space);
    }
    bool operator<(const Condition& other) const { return key() < other.key(); }
    bool operator==(const Condition& other) const { return key() == other.key(); }
};

/// A world model and what guides over it.
struct Contender {
    std::string model, guidance;

    bool operator<(const Contender& other) const {
        return std::tie(guidance, model) < std::tie(other.guidance, other.model);
    }
    bool operator==(const Contender& other) const {
        return model == other.model && guidance == other.guidance;
    }
};

/// The condition that a run was flown under, and who flew it.
Condition conditionOf(const Run& run);
Contender contenderOf(const Run& run);

std::string nameOf(const Contender& contender);  ///< "W-RoI, A*"
/// "4 m/s", and whatever is not as in the reference: planner 3dvfh, pose noise, latency x4, ...
std::string nameOf(const Condition& condition);
/// That alone: ", planner 3dvfh"; empty for the reference.
std::string deviationOf(const Condition& condition);

}  // namespace hagen::trials
