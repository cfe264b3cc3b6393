#include "ReportTables.h"

#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/Quantile.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <hagen/reports/Answer.h>
#include <hagen/reports/Figures.h>
#include <hagen/reports/Saturation.h>
#include "Phrases.h"

namespace hagen::reports {
namespace {

template <class Text>
pages::Table matrix(const Summary& summary, const trials::Condition& condition, Text text) {
    const std::vector<trials::Contender> contenders = contendersUnder(summary, condition);
    pages::Table table{{"scenario"}, {}};
    for (const trials::Contender& contender : contenders) table.header.push_back(nameOf(contender));
    for (const std::string& scenario : summary.scenarios) {
        std::vector<std::string> row{scenario};
        bool has_any = false;
        for (const trials::Contender& contender : contenders) {
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
    return pages::figure(of.median, decimals) + " (" + intervalText(of.median_interval, decimals) +
           ")";
}

}  // namespace

pages::Table successTable(const Summary& summary, const trials::Condition& condition) {
    return matrix(summary, condition,
                  [](const Cell& cell) { return percentOfRuns(cell.successes, cell.runs); });
}

pages::Table collisionTable(const Summary& summary, const trials::Condition& condition) {
    return matrix(summary, condition,
                  [](const Cell& cell) { return percentOfRuns(cell.collisions, cell.runs); });
}

pages::Table outcomeTable(const Summary& summary, const trials::Condition& condition) {
    pages::Table table{{"scenario", "contender", "runs", "success %", "collision %", "timeout %"},
                       {}};
    for (const Cell& cell : summary.cells) {
        if (!(cell.condition == condition) || cell.scenario.empty()) continue;
        table.rows.push_back({cell.scenario, nameOf(cell.contender), std::to_string(cell.runs),
                              percentOf(cell.successes, cell.runs),
                              percentOf(cell.collisions, cell.runs),
                              percentOf(cell.timeouts, cell.runs)});
    }
    return table;
}

pages::Table pairingTable(const std::vector<Pairing>& pairings) {
    pages::Table table{{"scenario", "condition", "first", "second", "pairs", "only first succeeded",
                        "only second succeeded", "difference, points", "p (Holm)", "first is",
                        "only one collided: first / second (p)"},
                       {}};
    for (const Pairing& pairing : pairings) {
        table.rows.push_back(
            {pairing.scenario.empty() ? "all" : pairing.scenario, nameOf(pairing.condition),
             nameOf(pairing.first), nameOf(pairing.second), std::to_string(pairing.pairs()),
             std::to_string(pairing.only_first), std::to_string(pairing.only_second),
             points(pairing.difference) + " (" + pointsOf(pairing.interval) + ")",
             pText(pairing.p_holm),
             answerOf(pairing) == Answer::Saturated ? nameOf(Answer::Saturated)
             : pairing.verdict == Verdict::Open     ? "undecided"
                                                    : nameOf(pairing.verdict),
             std::to_string(pairing.only_first_collided) + " / " +
                 std::to_string(pairing.only_second_collided) + " (" +
                 pText(trials::mcNemar(pairing.only_first_collided, pairing.only_second_collided)) +
                 ")"});
    }
    return table;
}

pages::Table pooledTable(const std::vector<Pairing>& pairings) {
    pages::Table table = pairingTable(pairings);
    const std::size_t place = 5;  // after "pairs"
    table.header.insert(table.header.begin() + place, "scenarios without a difference");
    for (std::size_t i = 0; i < pairings.size(); ++i) {
        table.rows[i].insert(table.rows[i].begin() + place,
                             std::to_string(pairings[i].alike_scenarios) + " of " +
                                 std::to_string(pairings[i].scenarios));
    }
    return table;
}

pages::Table saturationTable(const Summary& summary, const trials::Condition& condition) {
    pages::Table table{{"scenario", "contender", "compared with", "without a difference",
                        "at " + nameOf(condition), "not saturated at"},
                       {}};
    const std::vector<Saturation> all = saturationsOf(summary);
    for (const Saturation& one : all) {
        if (!(one.condition == condition)) continue;
        const std::optional<Saturation> other = unsaturated(all, one);
        table.rows.push_back({one.scenario, nameOf(one.first), counted(one.comparisons, "model"),
                              std::to_string(one.alike), one.is_saturated ? "saturated" : "differs",
                              other ? nameOf(other->condition) : "no speed flown"});
    }
    return table;
}

pages::Table speedTable(const Summary& summary) {
    pages::Table table{
        {"scenario", "contender", "highest speed flown, m/s",
         "highest speed with success >= 95 %, m/s", "highest speed with lower bound >= 95 %, m/s"},
        {}};
    for (const SpeedLimit& limit : summary.speed_limits) {
        const auto text = [](double speed) {
            return std::isnan(speed) ? "none" : pages::figure(speed, 1);
        };
        table.rows.push_back({limit.scenario + trials::deviationOf(limit.lowest),
                              nameOf(limit.contender), pages::figure(limit.flown_m_s, 1),
                              text(limit.highest_m_s), text(limit.sure_m_s)});
    }
    return table;
}

pages::Table squareTable(const Summary& summary, const trials::Condition& condition) {
    std::set<std::string> models, guidances, scenarios;
    for (const Cell& cell : summary.cells) {
        if (!(cell.condition == condition) || cell.scenario.empty()) continue;
        guidances.insert(cell.contender.guidance);
        // The true scene is the ceiling of the others, even if it flew with A* only.
        if (avoidance::needsTruth(cell.contender.model)) models.insert(cell.contender.model);
        if (cell.contender.guidance == "astar") continue;
        models.insert(cell.contender.model);
        scenarios.insert(cell.scenario);
    }
    pages::Table table{{"scenario", "world model"}, {}};
    for (const std::string& guidance : guidances) {
        table.header.push_back(guidance == "astar" ? "A*" : guidance);
    }
    for (const std::string& scenario : scenarios) {
        for (const std::string& model : models) {
            std::vector<std::string> row{scenario, avoidance::displayName(model)};
            for (const std::string& guidance : guidances) {
                const Cell* cell = find(summary, scenario, condition, {model, guidance});
                row.push_back(cell == nullptr ? "" : percentOfRuns(cell->successes, cell->runs));
            }
            // A row with a single figure compares nothing, unless it is the ceiling.
            const long figures =
                static_cast<long>(row.size()) - 2 - std::count(row.begin() + 2, row.end(), "");
            if (figures > (avoidance::needsTruth(model) ? 0 : 1)) {
                table.rows.push_back(row);
            }
        }
    }
    return table;
}

pages::Table flightTable(const SharedCourses& shared) {
    pages::Table table{
        {"contender", "courses", "minimum clearance p5, m", "minimum clearance median, m",
         "path / shortest path", "time to goal, s", "first reaction, m", "RMS jerk, m/s^3"},
        {}};
    for (const Cell& cell : shared.cells) {
        table.rows.push_back({nameOf(cell.contender), std::to_string(cell.runs),
                              pages::figure(cell.min_clearance_m.p05, 2),
                              spread(cell.min_clearance_m, 2), spread(cell.path_ratio, 3),
                              spread(cell.time_s, 1), spread(cell.first_reaction_m, 1),
                              spread(cell.rms_jerk_m_s3, 1)});
    }
    return table;
}

pages::Table wiresTable(const Summary& summary, const trials::Condition& condition) {
    pages::Table table{{"scenario", "contender", "runs", "success %", "collision %", "timeout %"},
                       {}};
    for (const char* scenario : {kWires, kThinWires}) {
        for (const trials::Contender& contender : contendersUnder(summary, condition)) {
            const Cell* cell = find(summary, scenario, condition, contender);
            if (cell == nullptr) continue;
            table.rows.push_back({scenario, nameOf(contender), std::to_string(cell->runs),
                                  percentOf(cell->successes, cell->runs),
                                  percentOf(cell->collisions, cell->runs),
                                  percentOf(cell->timeouts, cell->runs)});
        }
    }
    return table;
}

pages::Table shortfallTable(const trials::FlownRuns& flown) {
    pages::Table table{{"condition", "contender", "runs done", "runs planned"}, {}};
    for (const trials::Shortfall& one : flown.shortfalls) {
        table.rows.push_back({nameOf(one.condition), nameOf(one.contender),
                              std::to_string(one.flown), std::to_string(one.planned)});
    }
    return table;
}

pages::Table effortTable(const SharedCourses& shared) {
    pages::Table table{{"contender", "courses", "latency p50, ms", "latency p95, ms",
                        "latency max, ms", "dropped scans, %", "emergency stops per km"},
                       {}};
    for (const Cell& cell : shared.flown_cells) {
        table.rows.push_back(
            {nameOf(cell.contender), std::to_string(cell.runs),
             pages::figure(cell.latency_p50_ms.median, 1),
             pages::figure(cell.latency_p95_ms.median, 1), pages::figure(cell.latency_max_ms, 1),
             pages::figure(cell.dropped_percent, 2), pages::figure(cell.stops_per_km, 1)});
    }
    return table;
}

std::vector<std::string> stageNamesOf(const trials::Contender& contender,
                                      const std::string& planner,
                                      const trials::LatencyProfile& profile) {
    const std::vector<std::string>& known = avoidance::worldModelNames();
    if (std::find(known.begin(), known.end(), contender.model) == known.end()) return {};
    trials::TrialSetup setup;
    setup.model = contender.model;
    setup.guidance = contender.guidance;
    setup.planner = planner;
    std::vector<std::string> stages = trials::stagesOf(setup);
    stages.erase(std::remove_if(stages.begin(), stages.end(),
                                [&](const std::string& stage) {
                                    const auto found = profile.quantiles_ms.find(stage);
                                    return found == profile.quantiles_ms.end() ||
                                           found->second.empty();
                                }),
                 stages.end());
    return stages;
}

std::string stageText(const std::string& stage, const std::string& after_model) {
    const std::size_t slash = stage.find('/');
    if (slash == std::string::npos) return stage;
    const auto guidanceText = [](const std::string& guidance) {
        return guidance == "astar" ? "A*" : guidance;
    };
    std::string step = stage.substr(slash + 1);
    const std::size_t plus = step.find('+');
    step = plus == std::string::npos
               ? guidanceText(step)
               : step.substr(plus + 1) + " after " + guidanceText(step.substr(0, plus));
    if (after_model.empty()) return step;
    return avoidance::displayName(stage.substr(0, slash)) + after_model + step;
}

pages::Table stageTable(const Summary& summary, const trials::LatencyProfile& profile) {
    pages::Table table{{"stage", "p50, ms", "p95, ms", "max, ms"}, {}};
    if (summary.conditions.empty()) return table;
    std::set<std::string> shown;
    for (const trials::Contender& contender : summary.contenders) {
        for (const std::string& stage :
             stageNamesOf(contender, summary.conditions.front().planner, profile)) {
            if (!shown.insert(stage).second) continue;
            const std::vector<double>& q = profile.quantiles_ms.at(stage);
            table.rows.push_back({stageText(stage, ": "), pages::figure(base::quantile(q, 0.5), 2),
                                  pages::figure(base::quantile(q, 0.95), 2),
                                  pages::figure(q.back(), 2)});
        }
    }
    return table;
}

pages::Table measuredTable(const trials::MeasuredByContender& measured,
                           const trials::Condition& condition) {
    pages::Table table{{"contender", "runs", "peak heap median, MB", "peak heap max, MB"}, {}};
    std::set<std::string> stages;
    for (const auto& [what, runs] : measured) {
        for (const auto& [stage, values] : runs.p50_ms) stages.insert(stage);
    }
    for (const std::string& stage : stages) table.header.push_back(stage + " p50, ms");
    for (const auto& [what, runs] : measured) {
        if (!(what.first == condition)) continue;
        const std::vector<double>& bytes = runs.peak_model_bytes;
        std::vector<std::string> row{nameOf(what.second), std::to_string(bytes.size()),
                                     pages::figure(1e-6 * base::quantile(bytes, 0.5), 2),
                                     pages::figure(1e-6 * base::quantile(bytes, 1), 2)};
        for (const std::string& stage : stages) {
            const auto found = runs.p50_ms.find(stage);
            row.push_back(found == runs.p50_ms.end()
                              ? "-"
                              : pages::figure(base::quantile(found->second, 0.5), 2));
        }
        table.rows.push_back(row);
    }
    return table;
}

pages::Table memoryTable(const std::vector<trials::HeapCurve>& memory) {
    pages::Table table{{"world model", "distance flown, m", "heap at the end, MB", "peak heap, MB"},
                       {}};
    for (const trials::HeapCurve& curve : memory) {
        if (curve.bytes_by_path_m.empty()) continue;
        double peak = 0;
        for (const auto& [path_m, bytes] : curve.bytes_by_path_m) peak = std::max(peak, bytes);
        const auto& [path_m, bytes] = curve.bytes_by_path_m.back();
        table.rows.push_back({avoidance::displayName(curve.model), pages::figure(path_m, 0),
                              pages::figure(1e-6 * bytes, 2), pages::figure(1e-6 * peak, 2)});
    }
    return table;
}

}  // namespace hagen::reports
