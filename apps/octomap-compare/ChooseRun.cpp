#include "ChooseRun.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "Summary.h"

namespace hagen {
namespace {

bool matches(const Run& run, const RunWanted& wanted) {
    const auto is = [](const std::string& name, const std::string& value) {
        return name.empty() || name == value;
    };
    const TrialSetup& setup = run.setup;
    return run.seed == wanted.seed && is(wanted.scenario, run.scenario) &&
           is(wanted.model, setup.model) && is(wanted.guidance, setup.guidance) &&
           is(wanted.planner, setup.planner) && is(wanted.pose_error, nameOf(setup.pose_error)) &&
           is(wanted.unknown, setup.brakes_in_known_space ? "brake-known" : "optimistic") &&
           (wanted.speed_m_s == 0 || wanted.speed_m_s == setup.speed_m_s) &&
           (wanted.latency_scale == 0 || wanted.latency_scale == setup.latency_scale);
}

std::string listOf(const std::vector<Run>& runs) {
    constexpr std::size_t kMost = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(kMost, runs.size()); ++i) {
        list += "\n  " + choiceOf(runs[i]);
    }
    if (runs.size() > kMost) list += "\n  ...";
    return list;
}

/// A number as short as it can be told.
std::string shortText(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << value;
    return text.str();
}

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

/// A line a scenario: "gap: seeds 1000-1049, 4 m/s, G-Full,W-RoI, astar".
std::string overviewOf(const std::vector<Run>& runs) {
    struct Scenario {
        std::set<std::uint64_t> seeds;
        std::set<std::string> speeds_m_s, models, guidances;
    };
    std::map<std::string, Scenario> scenarios;
    for (const Run& run : runs) {
        Scenario& scenario = scenarios[run.scenario];
        scenario.seeds.insert(run.seed);
        scenario.speeds_m_s.insert(shortText(run.setup.speed_m_s));
        scenario.models.insert(run.setup.model);
        scenario.guidances.insert(run.setup.guidance);
    }
    std::ostringstream text;
    for (const auto& [name, scenario] : scenarios) {
        const std::uint64_t first = *scenario.seeds.begin(), last = *scenario.seeds.rbegin();
        text << "\n  " << name << ": seed" << (first == last ? " " : "s ") << first;
        if (last != first) text << "-" << last;
        text << ", " << joined(scenario.speeds_m_s) << " m/s, " << joined(scenario.models) << ", "
             << joined(scenario.guidances);
    }
    return text.str();
}

}  // namespace

std::string choiceOf(const Run& run) {
    const Condition condition{run.setup.speed_m_s, run.setup.planner, run.setup.pose_error,
                              run.setup.latency_scale, run.setup.brakes_in_known_space};
    return "--scenario " + run.scenario + " --model " + run.setup.model + " --guidance " +
           run.setup.guidance + "   (" + nameOf(condition) + ": " + nameOf(run.result.outcome) +
           ")";
}

std::string fileNameOf(const Run& run) {
    const TrialSetup &setup = run.setup, usual;
    std::string name = run.scenario + "-" + std::to_string(run.seed) + "-" + setup.model + "-" +
                       setup.guidance + "-" + shortText(setup.speed_m_s) + "mps";
    if (setup.planner != usual.planner) name += "-" + setup.planner;
    if (setup.pose_error != usual.pose_error) name += "-" + nameOf(setup.pose_error);
    if (setup.latency_scale != usual.latency_scale) {
        name += "-latency" + shortText(setup.latency_scale);
    }
    if (setup.brakes_in_known_space) name += "-brake-known";
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
    const std::string seed = "of seed " + std::to_string(wanted.seed);
    if (!found.empty()) {
        throw std::invalid_argument(std::to_string(found.size()) + " runs " + seed +
                                    " fit; choose one by flags:" + listOf(found));
    }
    const std::vector<Run> of_seed =
        thoseThat([&](const Run& run) { return run.seed == wanted.seed; });
    if (!of_seed.empty()) {
        throw std::invalid_argument("has no run " + seed +
                                    " with these flags; of that seed are:" + overviewOf(of_seed));
    }
    throw std::invalid_argument("has no run " + seed +
                                (runs.empty() ? ", nor any other" : "; there are:") +
                                overviewOf(runs));
}

}  // namespace hagen
