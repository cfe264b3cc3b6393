#include <hagen/reports/SummaryFiles.h>

#include <hagen/reports/Answer.h>
#include <hagen/reports/Figures.h>
#include <hagen/reports/Saturation.h>
#include <algorithm>
#include <cmath>
#include "SummaryJson.h"

namespace hagen::reports {
namespace {

using base::Json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json(const trials::Bounds& bounds) {
    return Json::array({number(bounds.low), number(bounds.high)});
}

Json json(const Spread& spread) {
    return {{"count", spread.count},
            {"p05", number(spread.p05)},
            {"median", number(spread.median)},
            {"p95", number(spread.p95)},
            {"median_interval", json(spread.median_interval)}};
}

/// Whole scans are not mentioned.
bool hasUpdates(const trials::Condition& condition) {
    return condition.updates != trials::Updates::Scans;
}

Json json(const trials::Condition& condition) {
    Json all{{"name", nameOf(condition)},
             {"speed_m_s", condition.speed_m_s},
             {"planner", condition.planner},
             {"pose_error", nameOf(condition.pose_error)},
             {"latency_scale", condition.latency_scale},
             {"unknown", condition.brakes_in_known_space ? "brake_known" : "optimistic"},
             {"air", nameOf(condition.air)},
             {"distance", nameOf(condition.distance)}};
    if (hasUpdates(condition)) all["updates"] = nameOf(condition.updates);
    return all;
}

Json json(const trials::Contender& contender) {
    return {{"model", contender.model}, {"guidance", contender.guidance}};
}

Json scenarioOf(const std::string& scenario) { return scenario.empty() ? Json() : Json(scenario); }

Json share(int part, int whole) {
    return {{"count", part},
            {"share", number(static_cast<double>(part) / whole)},
            {"interval", json(trials::wilsonInterval(part, whole))}};
}

Json json(const Cell& cell) {
    return {{"scenario", scenarioOf(cell.scenario)},
            {"condition", json(cell.condition)},
            {"model", cell.contender.model},
            {"guidance", cell.contender.guidance},
            {"runs", cell.runs},
            {"success", share(cell.successes, cell.runs)},
            {"collision", share(cell.collisions, cell.runs)},
            {"timeout", share(cell.timeouts, cell.runs)},
            {"min_clearance_m", json(cell.min_clearance_m)},
            {"path_over_oracle", json(cell.path_ratio)},
            {"time_s", json(cell.time_s)},
            {"first_reaction_m", json(cell.first_reaction_m)},
            {"rms_jerk_m_s3", json(cell.rms_jerk_m_s3)},
            {"latency_p50_ms", json(cell.latency_p50_ms)},
            {"latency_p95_ms", json(cell.latency_p95_ms)},
            {"latency_max_ms", number(cell.latency_max_ms)},
            {"dropped_scans_percent", number(cell.dropped_percent)},
            {"emergency_stops_per_km", number(cell.stops_per_km)}};
}

Json json(const Pairing& pairing) {
    return {{"scenario", scenarioOf(pairing.scenario)},
            {"condition", json(pairing.condition)},
            {"first", json(pairing.first)},
            {"second", json(pairing.second)},
            {"pairs", pairing.pairs()},
            {"both", pairing.both},
            {"only_first", pairing.only_first},
            {"only_second", pairing.only_second},
            {"neither", pairing.neither},
            {"only_first_collided", pairing.only_first_collided},
            {"only_second_collided", pairing.only_second_collided},
            {"difference", number(pairing.difference)},
            {"interval", json(pairing.interval)},
            {"scenarios", pairing.scenarios},
            {"thin_wires_left_out", pairing.repeated},
            {"scenarios_without_difference", pairing.alike_scenarios},
            {"p", number(pairing.p)},
            {"least_p", number(pairing.least_p)},
            {"p_holm", number(pairing.p_holm)},
            {"verdict", nameOf(pairing.verdict)},
            {"answer", nameOf(answerOf(pairing))}};
}

Json json(const Saturation& one) {
    return {{"scenario", one.scenario},       {"condition", json(one.condition)},
            {"model", one.first.model},       {"guidance", one.first.guidance},
            {"comparisons", one.comparisons}, {"comparisons_without_difference", one.alike},
            {"saturated", one.is_saturated}};
}

Json json(const SpeedLimit& limit) {
    const trials::Condition& c = limit.lowest;
    Json all{{"scenario", limit.scenario},
             {"model", limit.contender.model},
             {"guidance", limit.contender.guidance},
             {"planner", c.planner},
             {"pose_error", nameOf(c.pose_error)},
             {"latency_scale", c.latency_scale},
             {"unknown", c.brakes_in_known_space ? "brake_known" : "optimistic"},
             {"air", nameOf(c.air)},
             {"distance", nameOf(c.distance)},
             {"flown_m_s", number(limit.flown_m_s)},
             {"highest_m_s", number(limit.highest_m_s)},
             {"surely_m_s", number(limit.sure_m_s)}};
    if (hasUpdates(c)) all["updates"] = nameOf(c.updates);
    return all;
}

template <class Item>
Json list(const std::vector<Item>& items) {
    Json all = Json::array();
    for (const Item& item : items) all.push_back(json(item));
    return all;
}

std::string plain(double value) { return std::isfinite(value) ? pages::figure(value, 4) : ""; }

std::string row(const Cell& cell) {
    const auto shares = [&](int part) {
        const trials::Bounds bounds = trials::wilsonInterval(part, cell.runs);
        return std::to_string(part) + "," + plain(static_cast<double>(part) / cell.runs) + "," +
               plain(bounds.low) + "," + plain(bounds.high);
    };
    const trials::Condition& c = cell.condition;
    std::string text = cell.scenario + "," + plain(c.speed_m_s) + "," + c.planner + "," +
                       nameOf(c.pose_error) + "," + plain(c.latency_scale) + "," +
                       (c.brakes_in_known_space ? "brake_known" : "optimistic") + "," +
                       cell.contender.model + "," + cell.contender.guidance + "," +
                       std::to_string(cell.runs) + "," + shares(cell.successes) + "," +
                       shares(cell.collisions) + "," + shares(cell.timeouts);
    for (const Spread* spread :
         {&cell.min_clearance_m, &cell.path_ratio, &cell.time_s, &cell.first_reaction_m,
          &cell.rms_jerk_m_s3, &cell.latency_p50_ms, &cell.latency_p95_ms}) {
        text += "," + plain(spread->p05) + "," + plain(spread->median) + "," + plain(spread->p95);
    }
    return text + "," + plain(cell.latency_max_ms) + "," + plain(cell.dropped_percent) + "," +
           plain(cell.stops_per_km) + "," + nameOf(c.air) + "," + nameOf(c.distance);
}

}  // namespace

Json jsonOf(const Summary& summary) {
    return {{"runs", summary.runs},
            {"settings", summary.settings},
            {"versions", summary.versions},
            {"scenarios", summary.scenarios},
            {"conditions", list(summary.conditions)},
            {"contenders", list(summary.contenders)},
            {"margin", kMargin},
            {"cells", list(summary.cells)},
            {"overall", list(summary.overall)},
            {"without_wires", list(summary.without_wires)},
            {"pairings", list(summary.pairings)},
            {"to_oracle", list(summary.to_oracle)},
            {"motion_to_oracle", list(summary.motion_to_oracle)},
            {"saturation", list(saturationsOf(summary))},
            {"speed_limits", list(summary.speed_limits)}};
}

std::string summaryCsv(const Summary& summary) {
    std::string text =
        "scenario,speed,planner,pose_error,latency_scale,unknown,model,guidance,runs";
    for (const char* outcome : {"success", "collision", "timeout"}) {
        for (const char* what : {"", "_share", "_low", "_high"}) {
            text += std::string(",") + outcome + what;
        }
    }
    for (const char* measure : {"min_clearance_m", "path_over_oracle", "time_s", "first_reaction_m",
                                "rms_jerk_m_s3", "latency_p50_ms", "latency_p95_ms"}) {
        for (const char* what : {"_p05", "_median", "_p95"}) {
            text += std::string(",") + measure + what;
        }
    }
    text += ",latency_max_ms,dropped_scans_percent,emergency_stops_per_km,air,distance";
    const bool has_updates =
        std::any_of(summary.cells.begin(), summary.cells.end(),
                    [](const Cell& cell) { return hasUpdates(cell.condition); });
    text += has_updates ? ",updates\n" : "\n";
    for (const Cell& cell : summary.cells) {
        // Contenders flew different courses in all: their rates would not compare.
        if (cell.scenario.empty()) continue;
        text += row(cell) + (has_updates ? "," + nameOf(cell.condition.updates) : "") + "\n";
    }
    return text;
}

std::string summaryJson(const Summary& summary, const trials::FlownRuns& flown) {
    base::Json json = jsonOf(summary);
    if (flown.planned > 0) {
        json["planned_runs"] = flown.planned;
        json["missing_runs"] = flown.missing;
    }
    return json.dump(2) + "\n";
}

}  // namespace hagen::reports
