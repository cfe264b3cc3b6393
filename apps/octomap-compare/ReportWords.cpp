#include "ReportWords.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hagen {
namespace {

std::string points(double share) {
    const std::string text = fixed(100 * share, 1);
    return share > 0 && text != "0.0" ? "+" + text : text;
}

std::string pointsOf(const Bounds& bounds) {
    return points(bounds.low) + " to " + points(bounds.high);
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// Contenders with runs under a condition, in the summary's order.
std::vector<Contender> presentIn(const Summary& summary, const Condition& condition) {
    std::vector<Contender> present;
    for (const Contender& contender : summary.contenders) {
        if (find(summary, "", condition, contender) != nullptr) present.push_back(contender);
    }
    return present;
}

template <class Text>
Table matrix(const Summary& summary, const Condition& condition, Text text) {
    const std::vector<Contender> contenders = presentIn(summary, condition);
    Table table{{"scenario"}, {}};
    for (const Contender& contender : contenders) table.header.push_back(nameOf(contender));
    for (const std::string& scenario : summary.scenarios) {
        std::vector<std::string> row{scenario};
        bool has_any = false;
        for (const Contender& contender : contenders) {
            const Cell* cell = find(summary, scenario, condition, contender);
            row.push_back(cell == nullptr ? "" : text(*cell));
            has_any = has_any || cell != nullptr;
        }
        if (has_any) table.rows.push_back(row);
    }
    return table;
}

std::string spread(const Spread& of, int decimals) {
    if (of.count == 0) return "-";
    return fixed(of.median, decimals) + " (" + fixed(of.median_interval, decimals) + ")";
}

std::string spoken(const Contender& contender) {
    return contender.model + (contender.guidance == "astar" ? " with A*" : " flown straight");
}

/// "3 runs", "1 run".
std::string counted(int count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words) {
    if (words.size() < 2) return join(words, "");
    return join({words.begin(), words.end() - 1}, ", ") + " and " + words.back();
}

std::string placeOf(const std::string& scenario) {
    if (scenario == kAllButWires) return "where no wires are";
    return scenario == kWires ? "among wires" : scenario.empty() ? "" : "in " + scenario;
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

enum Answer { MoreOften, LessByMargin, LessOften, LessWithinMargin, WithinMargin, Undecided };

/// "More" and "less" only where the interval and McNemar's test, corrected, both say so.
Answer answerOf(const Pairing& pairing) {
    if (pairing.p_holm < 0.05) {
        if (pairing.interval.low > 0) return MoreOften;
        if (pairing.interval.high < -kMargin) return LessByMargin;
        if (pairing.interval.high < 0) {
            return pairing.interval.low > -kMargin ? LessWithinMargin : LessOften;
        }
    }
    return pairing.verdict == Verdict::NotInferior ? WithinMargin : Undecided;
}

std::string differenceOf(const Pairing& pairing) {
    const double n = pairing.pairs();
    const bool same_guidance = pairing.first.guidance == pairing.second.guidance;
    std::string who = spoken(pairing.first) + " against " +
                      (same_guidance ? pairing.second.model : spoken(pairing.second));
    const std::string place = placeOf(pairing.scenario);
    return capital(place) + (place.empty() ? "" : ", ") + who + ": success " +
           percent((pairing.both + pairing.only_first) / n) + " % against " +
           percent((pairing.both + pairing.only_second) / n) + " % of the same " +
           counted(pairing.pairs(), "course") + ", " + points(pairing.difference) +
           " points (95 % interval " + pointsOf(pairing.interval) + "; p " + pText(pairing.p_holm) +
           ")";
}

std::string marginText() { return fixed(100 * kMargin, 0) + " points"; }

std::string difference(const Pairing& pairing) {
    switch (answerOf(pairing)) {
        case WithinMargin:
            return differenceOf(pairing) + ". Not inferior: a loss of " + marginText() +
                   " is excluded.";
        case Undecided:
            return "Open: " + differenceOf(pairing) +
                   (pairing.verdict == Verdict::Inferior
                        ? ". With so many comparisons this may be chance."
                        : ".");
        default:
            return differenceOf(pairing) + ".";
    }
}

/// Where both were flown, if not in all scenarios of the condition: "u-trap and gap".
std::string scopeOf(const Summary& summary, const Pairing& overall) {
    std::vector<std::string> names;
    for (const Pairing& one : summary.pairings) {
        if (one.condition == overall.condition && one.first == overall.first &&
            one.second == overall.second) {
            names.push_back(one.scenario);
        }
    }
    std::set<std::string> flown;
    for (const Cell& cell : summary.cells) {
        if (cell.condition == overall.condition && !cell.scenario.empty()) {
            flown.insert(cell.scenario);
        }
    }
    return names.size() < flown.size() ? listed(names) : "";
}

/// What the verdict tells of: all scenarios together, but W-RoI against W-Full with wires apart.
std::vector<Pairing> told(const Summary& summary, const Condition& condition) {
    std::vector<Pairing> all;
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == condition)) continue;
        const std::vector<Pairing> apart = wiresApart(summary, pairing);
        if (apart.empty()) {
            all.push_back(pairing);
            all.back().scenario = scopeOf(summary, pairing);
        } else {
            all.insert(all.end(), apart.begin(), apart.end());
        }
    }
    return all;
}

/// The answer before the figures.
std::string headlineOf(const std::vector<Pairing>& pairings, const Condition& reference,
                       const std::string& guidance) {
    std::vector<std::string> of[Undecided + 1];
    for (const Pairing& pairing : pairings) {
        if (pairing.first.guidance != guidance || pairing.second.model == pairing.first.model ||
            pairing.second.model == "oracle") {
            continue;
        }
        const bool same_guidance = pairing.second.guidance == guidance;
        const std::string place = placeOf(pairing.scenario);
        of[answerOf(pairing)].push_back(
            (same_guidance ? pairing.second.model : spoken(pairing.second)) +
            (place.empty() ? "" : " (" + place + ")"));
    }
    const std::string margin = marginText();
    const std::string before[] = {"arrives more often than ", "arrives less often than ",
                                  "arrives less often than ", "arrives less often than ",
                                  "loses less than " + margin + ", if any, to "};
    const std::string after[] = {"", ", by more than " + margin, ", by how much is open",
                                 ", by less than " + margin, ""};
    const std::string subject = spoken({"W-RoI", guidance}) + " at " + nameOf(reference);
    std::string text;
    for (int answer = MoreOften; answer < Undecided; ++answer) {
        if (of[answer].empty()) continue;
        text += (text.empty() ? subject : " It") + " " + before[answer] + listed(of[answer]) +
                after[answer] + ".";
    }
    if (of[Undecided].empty()) return text;
    if (text.empty()) text = subject + ": nothing is decided yet.";
    return text + " Open: " + join(of[Undecided], ", ") + ".";
}

/// Where they were matters more than how many: scenarios are not equally hard.
std::string collisionWords(const Summary& summary, const Cell& all) {
    std::vector<std::string> places;
    for (const std::string& scenario : summary.scenarios) {
        const Cell* cell = find(summary, scenario, all.condition, all.contender);
        if (cell == nullptr || cell->collisions == 0) continue;
        places.push_back(scenario + " " + std::to_string(cell->collisions) + " of " +
                         std::to_string(cell->runs));
    }
    return capital(spoken(all.contender)) + ": " +
           (places.empty() ? "no collision" : counted(all.collisions, "collision")) + " in " +
           counted(all.runs, "run") + (places.empty() ? "" : " (" + join(places, ", ") + ")") + ".";
}

/// The most runs of one contender in one scenario.
int mostRuns(const Summary& summary, const Condition& condition) {
    int most = 0;
    for (const Cell& cell : summary.cells) {
        if (!cell.scenario.empty() && cell.condition == condition) most = std::max(most, cell.runs);
    }
    return most;
}

}  // namespace

std::vector<Pairing> wiresApart(const Summary& summary, const Pairing& overall) {
    const auto is_same = [&](const Pairing& one) {
        return one.condition == overall.condition && one.first == overall.first &&
               one.second == overall.second;
    };
    std::vector<Pairing> apart;
    for (const Pairing& one : summary.without_wires) {
        if (is_same(one)) apart.push_back(one);
    }
    if (apart.empty()) return apart;
    for (const Pairing& one : summary.pairings) {
        if (one.scenario == kWires && is_same(one)) apart.push_back(one);
    }
    return apart;
}

std::string differenceText(const Pairing& pairing) { return difference(pairing); }

std::string unfinishedWords(const FlownRuns& flown) {
    if (flown.missing == 0) return "";
    return "Unfinished: " + std::to_string(flown.planned - flown.missing) + " of " +
           counted(flown.planned, "run") +
           " planned so far are flown. All figures may still change: do not stop early because of "
           "them.";
}

std::vector<std::string> verdictOf(const Summary& summary) {
    if (summary.conditions.empty()) return {"Nothing was flown: the table has no runs."};
    const Condition& reference = summary.conditions.front();
    std::vector<Pairing> pairings = told(summary, reference);
    std::vector<std::string> words;
    for (const char* guidance : {"astar", "straight"}) {
        const std::string headline = headlineOf(pairings, reference, guidance);
        if (!headline.empty()) words.push_back(headline);
    }
    std::stable_partition(pairings.begin(), pairings.end(),
                          [](const Pairing& pairing) { return answerOf(pairing) != Undecided; });
    for (const Pairing& pairing : pairings) words.push_back(difference(pairing));
    if (!pairings.empty() && answerOf(pairings.back()) == Undecided) {
        words.push_back("What is open needs more courses to be decided.");
    }
    for (const Contender& contender : presentIn(summary, reference)) {
        const Cell& cell = *find(summary, "", reference, contender);
        if (contender.model == "W-RoI") words.push_back(collisionWords(summary, cell));
    }
    const int runs = mostRuns(summary, reference);
    words.push_back("This is no proof of safety: 0 collisions in " + counted(runs, "run") +
                    " of a scenario" + (runs == 1 ? " still allows" : " still allow") +
                    " a true share of " + percent(wilsonInterval(0, runs).high) +
                    " % (Wilson, 95 %).");
    return words;
}

std::vector<std::string> flownWords(const Report& report) {
    const Summary& summary = report.summary;
    std::vector<std::string> names;
    for (const Contender& contender : summary.contenders) names.push_back(nameOf(contender));
    std::vector<std::string> conditions;
    for (const Condition& condition : summary.conditions) conditions.push_back(nameOf(condition));
    std::set<std::uint64_t> seeds;
    for (const Run& run : report.flown.runs) seeds.insert(run.seed);
    std::vector<std::string> words{
        counted(summary.runs, "run") + " through " +
            counted(static_cast<int>(summary.scenarios.size()), "scenario") + ": " +
            join(summary.scenarios, ", ") + ".",
        "Contenders: " + join(names, "; ") + ".", "Conditions: " + join(conditions, "; ") + ".",
        "Settings " + join(summary.settings, ", ") + ", program version " +
            join(summary.versions, ", ") + "."};
    if (!seeds.empty()) {
        words.push_back(
            "Seeds " + std::to_string(*seeds.begin()) + " to " + std::to_string(*seeds.rbegin()) +
            "; a seed makes the same course for every contender, though not all may have "
            "flown it.");
    }
    if (report.profile) {
        words.push_back("Latencies are drawn from a profile measured on " +
                        report.profile->machine + " (" + report.profile->made_by + ", " +
                        report.profile->date + ").");
    }
    return words;
}

std::vector<Pairing> lossesOf(const Summary& summary) {
    std::vector<Pairing> losses;
    for (const Pairing& pairing : summary.pairings) {
        if (pairing.difference < 0 && pairing.second.model != "oracle") losses.push_back(pairing);
    }
    std::stable_sort(losses.begin(), losses.end(), [](const Pairing& a, const Pairing& b) {
        return a.difference < b.difference;
    });
    return losses;
}

Table successTable(const Summary& summary, const Condition& condition) {
    return matrix(summary, condition,
                  [](const Cell& cell) { return percentOfRuns(cell.successes, cell.runs); });
}

Table collisionTable(const Summary& summary, const Condition& condition) {
    return matrix(summary, condition,
                  [](const Cell& cell) { return percentOfRuns(cell.collisions, cell.runs); });
}

Table outcomeTable(const Summary& summary, const Condition& condition) {
    Table table{{"scenario", "contender", "runs", "success %", "collision %", "timeout %"}, {}};
    for (const Cell& cell : summary.cells) {
        if (!(cell.condition == condition) || cell.scenario.empty()) continue;
        table.rows.push_back({cell.scenario, nameOf(cell.contender), std::to_string(cell.runs),
                              percentOf(cell.successes, cell.runs),
                              percentOf(cell.collisions, cell.runs),
                              percentOf(cell.timeouts, cell.runs)});
    }
    return table;
}

Table pairingTable(const std::vector<Pairing>& pairings) {
    Table table{{"scenario", "condition", "first", "second", "pairs", "only first", "only second",
                 "difference, points", "p (Holm)", "first is", "collided: only first / second"},
                {}};
    for (const Pairing& pairing : pairings) {
        table.rows.push_back(
            {pairing.scenario.empty() ? "all" : pairing.scenario, nameOf(pairing.condition),
             nameOf(pairing.first), nameOf(pairing.second), std::to_string(pairing.pairs()),
             std::to_string(pairing.only_first), std::to_string(pairing.only_second),
             points(pairing.difference) + " (" + pointsOf(pairing.interval) + ")",
             pText(pairing.p_holm), nameOf(pairing.verdict),
             std::to_string(pairing.only_first_collided) + " / " +
                 std::to_string(pairing.only_second_collided)});
    }
    return table;
}

Table speedTable(const Summary& summary) {
    Table table{{"scenario", "contender", "highest speed with success >= 95 %, m/s",
                 "the same of the interval's lower bound, m/s"},
                {}};
    for (const SpeedLimit& limit : summary.speed_limits) {
        const auto text = [](double speed) { return std::isnan(speed) ? "none" : fixed(speed, 1); };
        table.rows.push_back({limit.scenario, nameOf(limit.contender), text(limit.highest_m_s),
                              text(limit.sure_m_s)});
    }
    return table;
}

Table squareTable(const Summary& summary, const Condition& condition) {
    std::set<std::string> models, guidances, scenarios;
    for (const Cell& cell : summary.cells) {
        if (!(cell.condition == condition) || cell.scenario.empty()) continue;
        guidances.insert(cell.contender.guidance);
        if (cell.contender.guidance == "astar") continue;
        models.insert(cell.contender.model);
        scenarios.insert(cell.scenario);
    }
    Table table{{"scenario", "model"}, {}};
    for (const std::string& guidance : guidances) {
        table.header.push_back(guidance == "astar" ? "A*" : guidance);
    }
    for (const std::string& scenario : scenarios) {
        for (const std::string& model : models) {
            std::vector<std::string> row{scenario, model};
            for (const std::string& guidance : guidances) {
                const Cell* cell = find(summary, scenario, condition, {model, guidance});
                row.push_back(cell == nullptr ? "" : percentOf(cell->successes, cell->runs));
            }
            // A row of one cell compares nothing.
            if (std::count(row.begin(), row.end(), "") + 2 < static_cast<long>(row.size()) - 1) {
                table.rows.push_back(row);
            }
        }
    }
    return table;
}

Table flightTable(const SharedCourses& shared) {
    Table table{{"contender", "courses", "least clearance p5, m", "median, m", "path / oracle's",
                 "time to goal, s", "first reaction, m", "RMS jerk, m/s^3"},
                {}};
    for (const Cell& cell : shared.cells) {
        table.rows.push_back({nameOf(cell.contender), std::to_string(cell.runs),
                              fixed(cell.min_clearance_m.p05, 2), spread(cell.min_clearance_m, 2),
                              spread(cell.path_ratio, 3), spread(cell.time_s, 1),
                              spread(cell.first_reaction_m, 1), spread(cell.rms_jerk_m_s3, 1)});
    }
    return table;
}

std::string sharedWords(const SharedCourses& shared) {
    const std::string guidance = shared.guidance == "astar" ? "With A*" : "Flown straight";
    const std::size_t count = shared.contenders.size();
    const std::string who = count == 1   ? nameOf(shared.contenders.front())
                            : count == 2 ? "both contenders"
                                         : "all " + std::to_string(count) + " contenders";
    std::string text = guidance + ": " + counted(shared.flown, "course") +
                       (shared.flown == 1 ? " was" : " were") + " flown by " + who;
    if (shared.flown == 0) return text + ", so there is nothing to compare.";
    if (shared.arrived == 0)
        return text + (count == 1 ? "; it arrived on none." : "; on none of these all arrived.");
    return text + "; on " + std::to_string(shared.arrived) + " of these all arrived" +
           (shared.reacted == shared.arrived
                ? "."
                : ", on " + std::to_string(shared.reacted) + " all reacted to something.");
}

Table wiresTable(const Summary& summary, const Condition& condition) {
    Table table{{"contender", "runs", "success %", "collision %", "timeout %"}, {}};
    for (const Contender& contender : presentIn(summary, condition)) {
        const Cell* cell = find(summary, kWires, condition, contender);
        if (cell == nullptr) continue;
        table.rows.push_back(
            {nameOf(contender), std::to_string(cell->runs), percentOf(cell->successes, cell->runs),
             percentOf(cell->collisions, cell->runs), percentOf(cell->timeouts, cell->runs)});
    }
    return table;
}

Table shortfallTable(const FlownRuns& flown) {
    Table table{{"condition", "contender", "runs flown", "planned"}, {}};
    for (const Shortfall& one : flown.shortfalls) {
        table.rows.push_back({nameOf(one.condition), nameOf(one.contender),
                              std::to_string(one.flown), std::to_string(one.planned)});
    }
    return table;
}

Table effortTable(const Summary& summary, const Condition& condition) {
    Table table{{"contender", "sensor to command p50, ms", "p95, ms", "max, ms", "dropped scans, %",
                 "emergency stops a km"},
                {}};
    for (const Contender& contender : presentIn(summary, condition)) {
        const Cell& cell = *find(summary, "", condition, contender);
        table.rows.push_back({nameOf(contender), fixed(cell.latency_p50_ms.median, 1),
                              fixed(cell.latency_p95_ms.median, 1), fixed(cell.latency_max_ms, 1),
                              fixed(cell.dropped_percent, 2), fixed(cell.stops_per_km, 1)});
    }
    return table;
}

std::vector<std::string> stageNamesOf(const Contender& contender, const std::string& planner,
                                      const LatencyProfile& profile) {
    TrialSetup setup;
    setup.model = contender.model;
    setup.guidance = contender.guidance;
    setup.planner = planner;
    std::vector<std::string> stages = stagesOf(setup);
    stages.erase(std::remove_if(stages.begin(), stages.end(),
                                [&](const std::string& stage) {
                                    const auto found = profile.quantiles_ms.find(stage);
                                    return found == profile.quantiles_ms.end() ||
                                           found->second.empty();
                                }),
                 stages.end());
    return stages;
}

Table stageTable(const Summary& summary, const LatencyProfile& profile) {
    Table table{{"stage", "p50, ms", "p95, ms", "max, ms"}, {}};
    if (summary.conditions.empty()) return table;
    std::set<std::string> shown;
    for (const Contender& contender : summary.contenders) {
        for (const std::string& stage :
             stageNamesOf(contender, summary.conditions.front().planner, profile)) {
            if (!shown.insert(stage).second) continue;
            const std::vector<double>& q = profile.quantiles_ms.at(stage);
            table.rows.push_back({stage, fixed(quantile(q, 0.5), 2), fixed(quantile(q, 0.95), 2),
                                  fixed(q.back(), 2)});
        }
    }
    return table;
}

Table measuredTable(const std::map<std::string, MeasuredRuns>& measured) {
    Table table{{"model", "runs", "peak heap, median, MB", "most, MB"}, {}};
    std::set<std::string> stages;
    for (const auto& [model, runs] : measured) {
        for (const auto& [stage, values] : runs.p50_ms) stages.insert(stage);
    }
    for (const std::string& stage : stages) table.header.push_back(stage + " p50, ms");
    for (const auto& [model, runs] : measured) {
        const std::vector<double>& bytes = runs.peak_model_bytes;
        std::vector<std::string> row{model, std::to_string(bytes.size()),
                                     fixed(1e-6 * quantile(bytes, 0.5), 2),
                                     fixed(1e-6 * quantile(bytes, 1), 2)};
        for (const std::string& stage : stages) {
            const auto found = runs.p50_ms.find(stage);
            row.push_back(found == runs.p50_ms.end() ? "-"
                                                     : fixed(quantile(found->second, 0.5), 2));
        }
        table.rows.push_back(row);
    }
    return table;
}

Table memoryTable(const std::vector<MemoryCurve>& memory) {
    Table table{{"model", "flown, m", "at the end, MB", "peak, MB"}, {}};
    for (const MemoryCurve& curve : memory) {
        if (curve.bytes_by_path_m.empty()) continue;
        double peak = 0;
        for (const auto& [path_m, bytes] : curve.bytes_by_path_m) peak = std::max(peak, bytes);
        const auto& [path_m, bytes] = curve.bytes_by_path_m.back();
        table.rows.push_back(
            {curve.model, fixed(path_m, 0), fixed(1e-6 * bytes, 2), fixed(1e-6 * peak, 2)});
    }
    return table;
}

}  // namespace hagen
