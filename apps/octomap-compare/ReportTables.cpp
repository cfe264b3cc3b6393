#include "ReportTables.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "Phrases.h"

namespace hagen {
namespace {

template <class Text>
Table matrix(const Summary& summary, const Condition& condition, Text text) {
    const std::vector<Contender> contenders = contendersUnder(summary, condition);
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

}  // namespace

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
    Table table{
        {"scenario", "condition", "first", "second", "pairs", "only first", "only second",
         "difference, points", "p (Holm)", "first is", "only it collided: first / second (p)"},
        {}};
    for (const Pairing& pairing : pairings) {
        table.rows.push_back(
            {pairing.scenario.empty() ? "all" : pairing.scenario, nameOf(pairing.condition),
             nameOf(pairing.first), nameOf(pairing.second), std::to_string(pairing.pairs()),
             std::to_string(pairing.only_first), std::to_string(pairing.only_second),
             points(pairing.difference) + " (" + pointsOf(pairing.interval) + ")",
             pText(pairing.p_holm), nameOf(pairing.verdict),
             std::to_string(pairing.only_first_collided) + " / " +
                 std::to_string(pairing.only_second_collided) + " (" +
                 pText(mcNemar(pairing.only_first_collided, pairing.only_second_collided)) + ")"});
    }
    return table;
}

Table speedTable(const Summary& summary) {
    Table table{
        {"scenario", "contender", "flown up to, m/s", "highest speed with success >= 95 %, m/s",
         "the same of the interval's lower bound, m/s"},
        {}};
    for (const SpeedLimit& limit : summary.speed_limits) {
        const auto text = [](double speed) { return std::isnan(speed) ? "none" : fixed(speed, 1); };
        table.rows.push_back({limit.scenario + deviationOf(limit.lowest), nameOf(limit.contender),
                              fixed(limit.flown_m_s, 1), text(limit.highest_m_s),
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
                row.push_back(cell == nullptr ? "" : percentOfRuns(cell->successes, cell->runs));
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

Table wiresTable(const Summary& summary, const Condition& condition) {
    Table table{{"contender", "runs", "success %", "collision %", "timeout %"}, {}};
    for (const Contender& contender : contendersUnder(summary, condition)) {
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
    for (const Contender& contender : contendersUnder(summary, condition)) {
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

Table measuredTable(const MeasuredByModel& measured) {
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
