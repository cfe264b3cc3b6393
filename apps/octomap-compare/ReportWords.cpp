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

std::string sentenceOf(const Pairing& pairing) {
    const double n = pairing.pairs();
    const std::string where = pairing.scenario.empty() ? "" : "In " + pairing.scenario + ", ";
    std::string text = where + nameOf(pairing.first) + " against " + nameOf(pairing.second) +
                       (pairing.scenario.empty() ? " at " : ", ") + nameOf(pairing.condition) +
                       ": success " + percent((pairing.both + pairing.only_first) / n) +
                       " % against " + percent((pairing.both + pairing.only_second) / n) +
                       " % of the same " + std::to_string(pairing.pairs()) + " courses, " +
                       points(pairing.difference) + " points (" + pointsOf(pairing.interval) + ")";
    return text;
}

/// "Better" and "less" only where McNemar's test, corrected, says so, too.
std::string verdictWords(const Pairing& pairing) {
    const std::string margin = fixed(100 * kMargin, 0) + " points";
    const bool is_certain = pairing.p_holm < 0.05;
    if (pairing.verdict == Verdict::Inferior) return "inferior by more than " + margin;
    if (pairing.verdict == Verdict::NotInferior) {
        return is_certain && pairing.interval.low > 0 ? "better" : "not inferior by " + margin;
    }
    if (is_certain && pairing.interval.high < 0) {
        return "less, but whether by " + margin + " is not decided";
    }
    return "not decided: more courses are needed to exclude a loss of " + margin;
}

std::string spoken(const Contender& contender) {
    return contender.model + (contender.guidance == "astar" ? " with A*" : " flown straight");
}

/// The answer before the figures.
std::string headlineOf(const Summary& summary, const Condition& reference,
                       const std::string& guidance) {
    std::vector<std::string> of[3];
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == reference) || pairing.first.guidance != guidance ||
            pairing.second.model == pairing.first.model || pairing.second.model == "oracle") {
            continue;
        }
        of[static_cast<int>(pairing.verdict)].push_back(spoken(pairing.second));
    }
    std::vector<std::string> parts;
    const char* words[] = {"not inferior to ", "inferior to ", "not decided against "};
    for (int verdict = 0; verdict < 3; ++verdict) {
        if (!of[verdict].empty()) parts.push_back(words[verdict] + join(of[verdict], ", "));
    }
    if (parts.empty()) return "";
    return "Without a map, " + spoken({"W-RoI", guidance}) + " at " + nameOf(reference) + ", is " +
           join(parts, "; ") + ", by success with a margin of " + fixed(100 * kMargin, 0) +
           " points.";
}

std::string collisionWords(const Cell& cell) {
    const Bounds bounds = wilsonInterval(cell.collisions, cell.runs);
    return nameOf(cell.contender) + ": " + std::to_string(cell.collisions) + " collisions in " +
           std::to_string(cell.runs) + " runs; the true share may be up to " +
           percent(bounds.high) + " %.";
}

}  // namespace

std::vector<std::string> verdictOf(const Summary& summary) {
    if (summary.conditions.empty()) return {"Nothing was flown: the table has no runs."};
    const Condition& reference = summary.conditions.front();
    std::vector<std::string> words;
    for (const char* guidance : {"astar", "straight"}) {
        const std::string headline = headlineOf(summary, reference, guidance);
        if (!headline.empty()) words.push_back(headline);
    }
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == reference)) continue;
        words.push_back(sentenceOf(pairing) + ": " + verdictWords(pairing) + " (p " +
                        pText(pairing.p_holm) + ").");
    }
    for (const Contender& contender : presentIn(summary, reference)) {
        if (contender.model != "W-RoI") continue;
        words.push_back(collisionWords(*find(summary, "", reference, contender)));
    }
    words.push_back(
        "None is proof of safety: 0 collisions in 200 runs still allow a true share of " +
        percent(wilsonInterval(0, 200).high) + " % (Wilson, 95 %).");
    return words;
}

std::vector<std::string> flownWords(const Report& report) {
    const Summary& summary = report.summary;
    std::vector<std::string> names;
    for (const Contender& contender : summary.contenders) names.push_back(nameOf(contender));
    std::vector<std::string> conditions;
    for (const Condition& condition : summary.conditions) conditions.push_back(nameOf(condition));
    std::set<std::uint64_t> seeds;
    for (const Run& run : report.runs) seeds.insert(run.seed);
    std::vector<std::string> words{
        std::to_string(summary.runs) + " runs through " + std::to_string(summary.scenarios.size()) +
            " scenarios: " + join(summary.scenarios, ", ") + ".",
        "Contenders: " + join(names, "; ") + ".", "Conditions: " + join(conditions, "; ") + ".",
        "Settings " + join(summary.settings, ", ") + ", program version " +
            join(summary.versions, ", ") + "."};
    if (!seeds.empty()) {
        words.push_back("Seeds " + std::to_string(*seeds.begin()) + " to " +
                        std::to_string(*seeds.rbegin()) +
                        "; all contenders fly the same courses, one a seed.");
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
                  [](const Cell& cell) { return percentOf(cell.successes, cell.runs); });
}

Table collisionTable(const Summary& summary, const Condition& condition) {
    return matrix(summary, condition,
                  [](const Cell& cell) { return percentOf(cell.collisions, cell.runs); });
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
        const auto text = [](double speed) {
            return std::isnan(speed) ? "none flown" : fixed(speed, 1);
        };
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

Table flightTable(const Summary& summary, const Condition& condition) {
    Table table{{"contender", "runs", "least clearance p5, m", "median, m", "path / oracle's",
                 "time to goal, s", "first reaction, m", "RMS jerk, m/s^3"},
                {}};
    for (const Contender& contender : presentIn(summary, condition)) {
        const Cell& cell = *find(summary, "", condition, contender);
        table.rows.push_back({nameOf(contender), std::to_string(cell.runs),
                              fixed(cell.min_clearance_m.p05, 2), spread(cell.min_clearance_m, 2),
                              spread(cell.path_ratio, 3), spread(cell.time_s, 1),
                              spread(cell.first_reaction_m, 1), spread(cell.rms_jerk_m_s3, 1)});
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
