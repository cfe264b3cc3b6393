#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/Quantile.h>
#include <hagen/reports/Summary.h>

#include <hagen/trials/TrialScore.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "RepeatedCourse.h"

namespace hagen::reports {
namespace {

bool isMap(const std::string& model) {
    constexpr const char* kOfMaps[] = {"O-", "G-", "R-", "D-"};
    return std::any_of(std::begin(kOfMaps), std::end(kOfMaps),
                       [&](const char* start) { return model.compare(0, 2, start) == 0; });
}

Spread spreadOf(const std::vector<double>& all) {
    std::vector<double> values;
    std::copy_if(all.begin(), all.end(), std::back_inserter(values),
                 [](double value) { return !std::isnan(value); });
    return {static_cast<int>(values.size()), base::quantile(values, 0.05),
            base::quantile(values, 0.5), base::quantile(values, 0.95),
            trials::medianInterval(values, 1000)};
}

using Runs = std::vector<const trials::Run*>;

template <class Value>
Spread spreadOf(const Runs& runs, Value value) {
    std::vector<double> values;
    for (const trials::Run* run : runs) values.push_back(value(*run));
    return spreadOf(values);
}

Spread spreadOf(const Runs& runs, double trials::TrialResult::*field) {
    return spreadOf(runs, [=](const trials::Run& run) { return run.result.*field; });
}

Runs ofOutcome(const Runs& runs, trials::Outcome outcome) {
    Runs chosen;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(chosen),
                 [=](const trials::Run* run) { return run->result.outcome == outcome; });
    return chosen;
}

/// Runs of a cell by the courses that they flew.
using Flights = std::map<std::pair<trials::Condition, trials::Contender>,
                         std::map<CourseKey, const trials::Run*>>;

struct Comparison {
    trials::Contender first, second;
};

/// The comparisons between contenders that flew under one condition.
std::vector<Comparison> comparisonsOf(const std::set<trials::Contender>& contenders) {
    std::vector<Comparison> comparisons;
    for (const trials::Contender& first : contenders) {
        if (first.model != kMappingFree && first.model != kMappingFreeWithMotion) continue;
        for (const trials::Contender& second : contenders) {
            // Pairs of these two once, the one with motion first.
            if (avoidance::needsTruth(second.model) || second.model == kMappingFreeWithMotion) {
                continue;
            }
            const bool same_guidance = second.guidance == first.guidance;
            const bool is_itself = second == first;
            const bool is_map_with_search = first.guidance == "straight" &&
                                            second.guidance != "straight" && isMap(second.model);
            const bool other_guidance = first.guidance != "straight" &&
                                        second.model == kMappingFree && first.model == kMappingFree;
            if (is_itself || !(same_guidance || is_map_with_search || other_guidance)) continue;
            comparisons.push_back({first, second});
        }
    }
    return comparisons;
}

/// Every model that flew under one condition against the true scene, in the order given.
std::vector<Comparison> gapsOf(const std::vector<trials::Contender>& order,
                               const std::set<trials::Contender>& present) {
    std::vector<Comparison> gaps;
    for (const trials::Contender& contender : order) {
        const trials::Contender oracle{kOracle, contender.guidance};
        if (!avoidance::needsTruth(contender.model) && present.count(contender) > 0 &&
            present.count(oracle) > 0) {
            gaps.push_back({contender, oracle});
        }
    }
    return gaps;
}

void count(const trials::Run& first, const trials::Run& second, Pairing& pairing) {
    const bool a = first.result.outcome == trials::Outcome::Success;
    const bool b = second.result.outcome == trials::Outcome::Success;
    ++(a ? (b ? pairing.both : pairing.only_first) : (b ? pairing.only_second : pairing.neither));
    const bool hit_a = first.result.outcome == trials::Outcome::Collision;
    const bool hit_b = second.result.outcome == trials::Outcome::Collision;
    if (hit_a && !hit_b) ++pairing.only_first_collided;
    if (hit_b && !hit_a) ++pairing.only_second_collided;
}

Pairing sumOf(const std::vector<Pairing>& parts, const std::string& name) {
    Pairing sum{name, parts.front().condition, parts.front().first, parts.front().second};
    sum.scenarios = static_cast<int>(parts.size());
    for (const Pairing& part : parts) {
        sum.of.push_back(part.scenario);
        sum.both += part.both;
        sum.only_first += part.only_first;
        sum.only_second += part.only_second;
        sum.neither += part.neither;
        sum.only_first_collided += part.only_first_collided;
        sum.only_second_collided += part.only_second_collided;
        sum.alike_scenarios += part.alike_scenarios;
        if (part.pairs() > sum.largest_pairs) {
            sum.largest_pairs = part.pairs();
            sum.largest_scenario = part.scenario;
        }
    }
    return sum;
}

/// The flights of two contenders on the courses that both flew.
using SharedFlights = std::map<CourseKey, std::pair<const trials::Run*, const trials::Run*>>;

SharedFlights sharedFlights(const Flights& flights, const trials::Condition& condition,
                            const Comparison& comparison) {
    const auto& second = flights.at({condition, comparison.second});
    SharedFlights shared;
    for (const auto& [course, run] : flights.at({condition, comparison.first})) {
        const auto other = second.find(course);
        if (other != second.end()) shared[course] = {run, other->second};
    }
    return shared;
}

/// By scenario.
std::vector<Pairing> pairingsOf(const SharedFlights& shared, const trials::Condition& condition,
                                const Comparison& comparison) {
    std::map<std::string, Pairing> by_scenario;
    for (const auto& [course, runs] : shared) {
        const Pairing none{course.first, condition, comparison.first, comparison.second};
        count(*runs.first, *runs.second, by_scenario.try_emplace(course.first, none).first->second);
    }
    std::vector<Pairing> pairings;
    for (auto& [scenario, pairing] : by_scenario) {
        pairing.alike_scenarios = pairing.discordant() == 0 ? 1 : 0;
        pairings.push_back(pairing);
    }
    return pairings;
}

/// Over all scenarios, each layout counted once.
Pairing totalOf(const SharedFlights& shared, const trials::Condition& condition,
                const Comparison& comparison) {
    SharedFlights distinct;
    for (const auto& [course, runs] : shared) {
        const CourseKey first = firstOfLayout(course);
        if (first == course || shared.count(first) == 0) distinct[course] = runs;
    }
    Pairing total = sumOf(pairingsOf(distinct, condition, comparison), "");
    total.repeated = static_cast<int>(shared.size() - distinct.size());
    return total;
}

void judge(Pairing& pairing) {
    const double n = pairing.pairs();
    pairing.p = trials::mcNemar(pairing.only_first, pairing.only_second);
    pairing.least_p = trials::leastMcNemar(pairing.discordant());
    pairing.difference = (pairing.only_first - pairing.only_second) / n;
    pairing.interval = trials::pairedDifferenceInterval(pairing.both, pairing.only_first,
                                                        pairing.only_second, pairing.neither);
    pairing.verdict = pairing.interval.low > -kMargin    ? Verdict::NotInferior
                      : pairing.interval.high < -kMargin ? Verdict::Inferior
                                                         : Verdict::Open;
}

void correct(std::vector<Pairing>& pairings) {
    std::vector<double> p, least_p;
    for (const Pairing& pairing : pairings) {
        p.push_back(pairing.p);
        least_p.push_back(pairing.least_p);
    }
    const std::vector<double> adjusted = trials::holmOfAttainable(p, least_p, kLevel);
    for (std::size_t i = 0; i < p.size(); ++i) pairings[i].p_holm = adjusted[i];
}

void addPairings(const Flights& flights, Summary& summary) {
    for (const trials::Condition& condition : summary.conditions) {
        std::set<trials::Contender> present;
        for (const auto& [key, runs] : flights) {
            if (key.first == condition) present.insert(key.second);
        }
        for (const Comparison& comparison : comparisonsOf(present)) {
            const SharedFlights shared = sharedFlights(flights, condition, comparison);
            if (shared.empty()) continue;
            const std::vector<Pairing> each = pairingsOf(shared, condition, comparison);
            summary.overall.push_back(totalOf(shared, condition, comparison));
            summary.pairings.insert(summary.pairings.end(), each.begin(), each.end());
            std::vector<Pairing> others;
            std::copy_if(each.begin(), each.end(), std::back_inserter(others),
                         [](const Pairing& one) { return !isWires(one.scenario); });
            const bool is_full_window = comparison.second.model == "W-Full";
            if (is_full_window && !others.empty() && others.size() < each.size()) {
                summary.without_wires.push_back(sumOf(others, kAllButWires));
            }
        }
        for (const Comparison& gap : gapsOf(summary.contenders, present)) {
            const std::vector<Pairing> each =
                pairingsOf(sharedFlights(flights, condition, gap), condition, gap);
            summary.to_oracle.insert(summary.to_oracle.end(), each.begin(), each.end());
        }
        for (const trials::Contender& with_motion : present) {
            const trials::Contender oracle{kOracle, with_motion.guidance};
            if (with_motion.model != kOracleWithMotion || present.count(oracle) == 0) continue;
            const Comparison worth{with_motion, oracle};
            const std::vector<Pairing> each =
                pairingsOf(sharedFlights(flights, condition, worth), condition, worth);
            summary.motion_to_oracle.insert(summary.motion_to_oracle.end(), each.begin(),
                                            each.end());
        }
    }
    for (std::vector<Pairing>* pairings :
         {&summary.overall, &summary.pairings, &summary.without_wires, &summary.to_oracle,
          &summary.motion_to_oracle}) {
        for (Pairing& pairing : *pairings) judge(pairing);
        correct(*pairings);
    }
}

void addCells(const Flights& flights, Summary& summary) {
    for (const trials::Condition& condition : summary.conditions) {
        std::vector<Cell> all;
        for (const std::string& scenario : summary.scenarios) {
            for (const trials::Contender& contender : summary.contenders) {
                const auto found = flights.find({condition, contender});
                if (found == flights.end()) continue;
                Runs runs, everywhere;
                for (const auto& [course, run] : found->second) {
                    everywhere.push_back(run);
                    if (run->scenario == scenario) runs.push_back(run);
                }
                if (!runs.empty()) summary.cells.push_back(cellOf(scenario, runs));
                if (scenario == summary.scenarios.front()) all.push_back(cellOf("", everywhere));
            }
        }
        summary.cells.insert(summary.cells.end(), all.begin(), all.end());
    }
}

/// Compares speeds under otherwise equal conditions, from low to high.
void addSpeedLimits(Summary& summary) {
    std::map<std::tuple<std::string, trials::Contender, trials::Condition>,
             std::map<double, const Cell*>>
        series;
    for (const Cell& cell : summary.cells) {
        if (cell.scenario.empty()) continue;
        trials::Condition without_speed = cell.condition;
        without_speed.speed_m_s = 0;
        series[{cell.scenario, cell.contender, without_speed}][cell.condition.speed_m_s] = &cell;
    }
    for (const auto& [key, cells] : series) {
        if (cells.size() < 2) continue;
        SpeedLimit limit{std::get<0>(key),
                         cells.begin()->second->condition,
                         std::get<1>(key),
                         cells.rbegin()->first,
                         NAN,
                         NAN};
        bool holds = true, surely = true;
        for (const auto& [speed_m_s, cell] : cells) {
            holds = holds && cell->successes >= 0.95 * cell->runs;
            surely = surely && trials::wilsonInterval(cell->successes, cell->runs).low >= 0.95;
            if (holds) limit.highest_m_s = speed_m_s;
            if (surely) limit.sure_m_s = speed_m_s;
        }
        summary.speed_limits.push_back(limit);
    }
}

template <class Value>
std::vector<Value> listOf(const std::set<Value>& values) {
    return {values.begin(), values.end()};
}

void addNames(const std::vector<trials::Run>& runs, Summary& summary) {
    std::map<trials::Condition, int> conditions;
    std::set<std::string> scenarios, settings, versions;
    std::set<trials::Contender> contenders;
    for (const trials::Run& run : runs) {
        ++conditions[trials::conditionOf(run)];
        scenarios.insert(run.scenario);
        settings.insert(run.settings_hash);
        versions.insert(run.version);
        contenders.insert(trials::contenderOf(run));
    }
    for (const auto& [condition, count] : conditions) summary.conditions.push_back(condition);
    std::stable_sort(summary.conditions.begin(), summary.conditions.end(),
                     [&](const trials::Condition& a, const trials::Condition& b) {
                         return conditions.at(a) > conditions.at(b);
                     });
    summary.scenarios = listOf(scenarios);
    summary.settings = listOf(settings);
    summary.versions = listOf(versions);
    summary.contenders = listOf(contenders);
    const auto rank = [](const trials::Contender& contender) {
        const std::string& model = contender.model;
        return std::make_tuple(contender.guidance, avoidance::needsTruth(model),
                               model == kMappingFree             ? 0
                               : model == kMappingFreeWithMotion ? 1
                               : model == "W-Full"               ? 2
                                                                 : 3,
                               model);
    };
    std::sort(
        summary.contenders.begin(), summary.contenders.end(),
        [&](const trials::Contender& a, const trials::Contender& b) { return rank(a) < rank(b); });
}

}  // namespace

Cell cellOf(const std::string& scenario, const Runs& runs) {
    Cell cell{scenario, trials::conditionOf(*runs[0]), trials::contenderOf(*runs[0])};
    const Runs won = ofOutcome(runs, trials::Outcome::Success);
    cell.runs = static_cast<int>(runs.size());
    cell.successes = static_cast<int>(won.size());
    cell.collisions = static_cast<int>(ofOutcome(runs, trials::Outcome::Collision).size());
    cell.timeouts = cell.runs - cell.successes - cell.collisions;
    cell.min_clearance_m = spreadOf(runs, &trials::TrialResult::min_clearance_m);
    cell.path_ratio =
        spreadOf(won, [](const trials::Run& run) {  // a flight ends this far from the goal
            return run.result.path_m / (run.oracle_path_m - trials::TrialJudge::kArrived_m);
        });
    cell.time_s = spreadOf(won, &trials::TrialResult::time_s);
    cell.first_reaction_m = spreadOf(won, &trials::TrialResult::first_reaction_m);
    cell.rms_jerk_m_s3 = spreadOf(won, &trials::TrialResult::rms_jerk_m_s3);
    cell.latency_p50_ms = spreadOf(runs, &trials::TrialResult::latency_p50_ms);
    cell.latency_p95_ms = spreadOf(runs, &trials::TrialResult::latency_p95_ms);
    double scans = 0, dropped = 0, stops = 0, path_m = 0;
    for (const trials::Run* run : runs) {
        scans += run->result.scans;
        dropped += run->result.dropped_scans;
        stops += run->result.emergency_stops;
        path_m += run->result.path_m;
        cell.latency_max_ms = std::fmax(cell.latency_max_ms, run->result.latency_max_ms);
    }
    cell.dropped_percent = 100 * dropped / scans;
    cell.stops_per_km = 1000 * stops / path_m;
    return cell;
}

Summary summarize(const std::vector<trials::Run>& runs) {
    Summary summary;
    summary.runs = static_cast<int>(runs.size());
    if (runs.empty()) return summary;
    addNames(runs, summary);
    Flights flights;
    for (const trials::Run& run : runs) {
        flights[{trials::conditionOf(run), trials::contenderOf(run)}][{run.scenario, run.seed}] =
            &run;
    }
    addCells(flights, summary);
    addPairings(flights, summary);
    addSpeedLimits(summary);
    return summary;
}

const Cell* find(const Summary& summary, const std::string& scenario,
                 const trials::Condition& condition, const trials::Contender& contender) {
    for (const Cell& cell : summary.cells) {
        if (cell.scenario == scenario && cell.condition == condition &&
            cell.contender == contender) {
            return &cell;
        }
    }
    return nullptr;
}

std::vector<trials::Contender> contendersUnder(const Summary& summary,
                                               const trials::Condition& condition) {
    std::vector<trials::Contender> present;
    for (const trials::Contender& contender : summary.contenders) {
        if (find(summary, "", condition, contender) != nullptr) present.push_back(contender);
    }
    return present;
}

bool isWires(const std::string& scenario) { return scenario == kWires || scenario == kThinWires; }

std::string nameOf(Verdict verdict) {
    return verdict == Verdict::NotInferior ? "not inferior"
           : verdict == Verdict::Inferior  ? "inferior"
                                           : "open";
}

}  // namespace hagen::reports
