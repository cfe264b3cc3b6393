#include "avoidance/replays/ChooseRun.h"
#include "base/NumberText.h"
#include "base/Text.h"
#include "base/TextStream.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

/// A condition that is omitted if it has its default value.
struct Condition {
    std::string flag;
    std::string (*valueOf)(const Run&);
};

std::string unknownOf(const Run& run) {
    return run.setup.brakes_in_known_space ? "brake-known" : "optimistic";
}

const std::vector<Condition>& conditions() {
    static const std::vector<Condition> all{
        {"--planner", [](const Run& run) { return run.setup.planner; }},
        {"--pose-error", [](const Run& run) { return nameOf(run.setup.pose_error); }},
        {"--latency-scale",
         [](const Run& run) { return base::shortestText(run.setup.latency_scale); }},
        {"--unknown", unknownOf},
        {"--air", [](const Run& run) { return nameOf(run.setup.air); }},
        {"--distance", [](const Run& run) { return nameOf(run.setup.distance); }},
        {"--updates", [](const Run& run) { return nameOf(run.setup.updates); }}};
    return all;
}

bool matches(const Run& run, const RunWanted& wanted) {
    const auto is = [](const std::string& name, const std::string& value) {
        return name.empty() || name == value;
    };
    const TrialSetup& setup = run.setup;
    return run.seed == wanted.seed && is(wanted.scenario, run.scenario) &&
           is(wanted.model, setup.model) && is(wanted.guidance, setup.guidance) &&
           is(wanted.planner, setup.planner) && is(wanted.pose_error, nameOf(setup.pose_error)) &&
           is(wanted.unknown, unknownOf(run)) && is(wanted.air, nameOf(setup.air)) &&
           is(wanted.distance, nameOf(setup.distance)) &&
           is(wanted.updates, nameOf(setup.updates)) &&
           (wanted.speed_m_s == 0 || wanted.speed_m_s == setup.speed_m_s) &&
           (wanted.latency_scale == 0 || wanted.latency_scale == setup.latency_scale);
}

std::string listOf(const std::vector<Run>& runs) {
    constexpr std::size_t kMax = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(kMax, runs.size()); ++i) {
        list += "\n  " + choiceOf(runs[i], runs);
    }
    if (runs.size() > kMax) list += "\n  ...";
    return list;
}

/// One line per scenario: "gap: seeds 1000-1049, 4 m/s, G-Full,W-RoI, astar".
std::string overviewOf(const std::vector<Run>& runs) {
    struct Scenario {
        std::set<std::uint64_t> seeds;
        std::set<std::string> speeds_m_s, models, guidances;
    };
    std::map<std::string, Scenario> scenarios;
    for (const Run& run : runs) {
        Scenario& scenario = scenarios[run.scenario];
        scenario.seeds.insert(run.seed);
        scenario.speeds_m_s.insert(base::shortestText(run.setup.speed_m_s));
        scenario.models.insert(run.setup.model);
        scenario.guidances.insert(run.setup.guidance);
    }
    base::TextStream text;
    for (const auto& [name, scenario] : scenarios) {
        const std::uint64_t first = *scenario.seeds.begin(), last = *scenario.seeds.rbegin();
        text << "\n  " << name << ": seed" << (first == last ? " " : "s ") << first;
        if (last != first) text << "-" << last;
        text << ", " << base::joined(scenario.speeds_m_s, ",") << " m/s, "
             << base::joined(scenario.models, ",") << ", " << base::joined(scenario.guidances, ",");
    }
    return text.str();
}

}  // namespace

std::string choiceOf(const Run& run, const std::vector<Run>& among) {
    std::string flags = "--scenario " + run.scenario + " --model " + run.setup.model +
                        " --guidance " + run.setup.guidance + " --speed " +
                        base::shortestText(run.setup.speed_m_s);
    for (const Condition& condition : conditions()) {
        const std::string value = condition.valueOf(run);
        const bool is_common = value == condition.valueOf(Run{}) &&
                               std::all_of(among.begin(), among.end(), [&](const Run& other) {
                                   return condition.valueOf(other) == value;
                               });
        if (!is_common) flags += " " + condition.flag + " " + value;
    }
    return flags + "   # " + nameOf(run.result.outcome);
}

std::string fileNameOf(const Run& run) {
    const TrialSetup& setup = run.setup;
    std::string name = run.scenario + "-" + std::to_string(run.seed) + "-" + setup.model + "-" +
                       setup.guidance + "-" + base::shortestText(setup.speed_m_s) + "mps";
    for (const Condition& condition : conditions()) {
        const std::string value = condition.valueOf(run);
        if (value == condition.valueOf(Run{})) continue;
        name += (condition.flag == "--latency-scale" ? "-latency" : "-") + value;
    }
    return name;
}

Run chooseRun(const std::vector<Run>& runs, const RunWanted& wanted) {
    const auto thoseThat = [&](const auto& fit) {
        std::vector<Run> found;
        std::copy_if(runs.begin(), runs.end(), std::back_inserter(found), fit);
        return found;
    };
    const std::vector<Run> found = thoseThat([&](const Run& run) { return matches(run, wanted); });
    if (found.size() == 1) return found[0];
    const std::string seed = "with seed " + std::to_string(wanted.seed);
    if (!found.empty()) {
        throw std::invalid_argument(std::to_string(found.size()) + " runs " + seed +
                                    " match; select one by flags:" + listOf(found));
    }
    const std::vector<Run> of_seed =
        thoseThat([&](const Run& run) { return run.seed == wanted.seed; });
    if (!of_seed.empty()) {
        throw std::invalid_argument("has no run " + seed +
                                    " and these flags; available:" + overviewOf(of_seed));
    }
    throw std::invalid_argument(runs.empty()
                                    ? "contains no runs"
                                    : "has no run " + seed + "; available:" + overviewOf(runs));
}

}  // namespace hagen::avoidance
