#include <hagen/avoidance/WorldModel.h>
#include <hagen/trials/Condition.h>

namespace hagen::trials {
namespace {

/// Without trailing zeros.
std::string numberText(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace

Condition conditionOf(const Run& run) {
    const TrialSetup& setup = run.setup;
    return {setup.speed_m_s,
            setup.planner,
            setup.pose_error,
            setup.latency_scale,
            setup.brakes_in_known_space,
            setup.air,
            setup.distance,
            setup.updates};
}

Contender contenderOf(const Run& run) { return {run.setup.model, run.setup.guidance}; }

std::string nameOf(const Contender& contender) {
    return avoidance::displayName(contender.model) + ", " +
           (contender.guidance == "astar" ? "A*" : contender.guidance);
}

std::string nameOf(const Condition& condition) {
    return numberText(condition.speed_m_s) + " m/s" + deviationOf(condition);
}

std::string deviationOf(const Condition& condition) {
    std::string name;
    if (condition.planner != "primitives") name += ", planner " + condition.planner;
    if (condition.pose_error != PoseError::None) name += ", pose " + nameOf(condition.pose_error);
    if (condition.latency_scale != 1) name += ", latency x" + numberText(condition.latency_scale);
    if (condition.brakes_in_known_space) name += ", brakes in known space";
    if (condition.air != Air::Dusty) name += ", " + nameOf(condition.air) + " air";
    if (condition.distance != ModelDistance::Unbiased) name += ", distances as stored";
    if (condition.updates != Updates::Scans) name += ", " + nameOf(condition.updates);
    return name;
}

}  // namespace hagen::trials
