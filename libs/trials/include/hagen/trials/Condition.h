#pragma once
#include <hagen/trials/RunTable.h>
#include <string>
#include <tuple>

namespace hagen::trials {

/// What compared runs have in common: everything except scenario, model and guidance.
struct Condition {
    double speed_m_s;
    std::string planner;
    PoseError pose_error;
    double latency_scale;
    bool brakes_in_known_space;
    Air air = Air::Dusty;
    ModelDistance distance = ModelDistance::Unbiased;
    Updates updates = Updates::Scans;

    auto key() const {
        return std::tie(speed_m_s, planner, pose_error, latency_scale, brakes_in_known_space, air,
                        distance, updates);
    }
    bool operator<(const Condition& other) const { return key() < other.key(); }
    bool operator==(const Condition& other) const { return key() == other.key(); }
};

/// A world model with a guidance.
struct Contender {
    std::string model, guidance;

    bool operator<(const Contender& other) const {
        return std::tie(guidance, model) < std::tie(other.guidance, other.model);
    }
    bool operator==(const Contender& other) const {
        return model == other.model && guidance == other.guidance;
    }
};

/// The condition and the contender of a run.
Condition conditionOf(const Run& run);
Contender contenderOf(const Run& run);

/// For people: "RoI window, A*".
std::string nameOf(const Contender& contender);
/// The speed and every deviation from the defaults: "4 m/s, planner 3dvfh, latency x4".
std::string nameOf(const Condition& condition);
/// Only the deviations: ", planner 3dvfh"; empty if there are none.
std::string deviationOf(const Condition& condition);

}  // namespace hagen::trials
