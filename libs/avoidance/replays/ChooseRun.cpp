#include <hagen/avoidance/ChooseRun.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/TextStream.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

std::string unknownOf(const avoidance::Run& run) {
    return run.setup.brakes_in_known_space ? "brake-known" : "optimistic";
}

bool matches(const avoidance::Run& run, const RunWanted& wanted) {
    const auto is = [](const std::string& name, const std::string& value) {
        return name.empty() || name == value;
    };
    const avoidance::TrialSetup& setup = run.setup;
    return run.seed == wanted.seed && is(wanted.scenario, run.scenario) &&
           is(wanted.model, setup.model) && is(wanted.guidance, setup.guidance) &&
           is(wanted.planner, setup.planner) && is(wanted.pose_error, nameOf(setup.pose_error)) &&
           is(wanted.unknown, unknownOf(run)) && is(wanted.air, nameOf(setup.air)) &&
           is(wanted.distance, nameOf(setup.distance)) &&
           is(wanted.updates, nameOf(setup.updates)) &&
           (wanted.speed_m_s == 0 || wanted.speed_m_s == setup.speed_m_s) &&
           (wanted.latency_scale == 0 || wanted.latency_scale == setup.latency_scale);
}

std::string listOf(const std::vector<avoidance::Run>& runs) {
    constexpr std::size_t kMost = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(kMost, runs.size()); ++i) {
        list += "\n  " + choiceOf(runs[i], runs);
    }
    if (runs.size() > kMost) list += "\n  ...";
    return list;
}

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

/// One line per scenario: "gap: seeds 1000-1049, 4 m/s, G-Full,W-RoI, astar".
std::string overviewOf(const std::vector<avoidance::Run>& runs) {
    struct Scenario {
        std::set<std::uint64_t> seeds;
        std::set<std::string> speeds_m_s, models, guidances;
    };
    std::map<std::string, Scenario> scenarios;
    for (const avoidance::Run& run : runs) {
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
        text << ", " << joined(scenario.speeds_m_s) << " m/s, " << joined(scenario.models) << ", "
             << joined(scenario.guidances);
    }
    return text.str();
}

}  // namespace

std::string choiceOf(const avoidance::Run& run, const std::vector<avoidance::Run>& among) {
    const avoidance::TrialSetup &setup = run.setup, usual;
    std::string flags = "--scenario " + run.scenario + " --model " + setup.model + " --guidance " +
                        setup.guidance + " --speed " + base::shortestText(setup.speed_m_s);
    // Defaults are left out unless other runs differ in them.
    const auto add = [&](const std::string& flag, const auto& valueOf, bool is_usual) {
        const auto differs = [&](const avoidance::Run& other) {
            return valueOf(other) != valueOf(run);
        };
        if (is_usual && std::none_of(among.begin(), among.end(), differs)) return;
        flags += " " + flag + " " + valueOf(run);
    };
    add(
        "--planner", [](const avoidance::Run& one) { return one.setup.planner; },
        setup.planner == usual.planner);
    add(
        "--pose-error", [](const avoidance::Run& one) { return nameOf(one.setup.pose_error); },
        setup.pose_error == usual.pose_error);
    add(
        "--latency-scale",
        [](const avoidance::Run& one) { return base::shortestText(one.setup.latency_scale); },
        setup.latency_scale == usual.latency_scale);
    add("--unknown", unknownOf, setup.brakes_in_known_space == usual.brakes_in_known_space);
    add(
        "--air", [](const avoidance::Run& one) { return nameOf(one.setup.air); },
        setup.air == usual.air);
    add(
        "--distance", [](const avoidance::Run& one) { return nameOf(one.setup.distance); },
        setup.distance == usual.distance);
    add(
        "--updates", [](const avoidance::Run& one) { return nameOf(one.setup.updates); },
        setup.updates == usual.updates);
    return flags + "   # " + nameOf(run.result.outcome);
}

std::string fileNameOf(const avoidance::Run& run) {
    const avoidance::TrialSetup &setup = run.setup, usual;
    std::string name = run.scenario + "-" + std::to_string(run.seed) + "-" + setup.model + "-" +
                       setup.guidance + "-" + base::shortestText(setup.speed_m_s) + "mps";
    if (setup.planner != usual.planner) name += "-" + setup.planner;
    if (setup.pose_error != usual.pose_error) name += "-" + nameOf(setup.pose_error);
    if (setup.latency_scale != usual.latency_scale) {
        name += "-latency" + base::shortestText(setup.latency_scale);
    }
    if (setup.brakes_in_known_space) name += "-brake-known";
    if (setup.air != usual.air) name += "-" + nameOf(setup.air);
    if (setup.distance != usual.distance) name += "-" + nameOf(setup.distance);
    if (setup.updates != usual.updates) name += "-" + nameOf(setup.updates);
    return name;
}

avoidance::Run chooseRun(const std::vector<avoidance::Run>& runs, const RunWanted& wanted) {
    const auto thoseThat = [&](const auto& fit) {
        std::vector<avoidance::Run> found;
        std::copy_if(runs.begin(), runs.end(), std::back_inserter(found), fit);
        return found;
    };
    const std::vector<avoidance::Run> found =
        thoseThat([&](const avoidance::Run& run) { return matches(run, wanted); });
    if (found.size() == 1) return found[0];
    const std::string seed = "of seed " + std::to_string(wanted.seed);
    if (!found.empty()) {
        throw std::invalid_argument(std::to_string(found.size()) + " runs " + seed +
                                    " match; select one by flags:" + listOf(found));
    }
    const std::vector<avoidance::Run> of_seed =
        thoseThat([&](const avoidance::Run& run) { return run.seed == wanted.seed; });
    if (!of_seed.empty()) {
        throw std::invalid_argument("has no run " + seed +
                                    " with these flags; that seed has:" + overviewOf(of_seed));
    }
    throw std::invalid_argument("has no run " + seed +
                                (runs.empty() ? ", nor any other" : "; there are:") +
                                overviewOf(runs));
}

}  // namespace hagen::avoidance
