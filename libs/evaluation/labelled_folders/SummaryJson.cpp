#include "evaluation/labelled_folders/SummaryJson.h"

#include <cmath>
#include "base/Json.h"
#include "base/WriteFile.h"
#include "settings/SettingsJson.h"

namespace hagen::evaluation {
namespace {

using base::Json;

Json number(double value) { return std::isnan(value) ? Json() : Json(value); }
Json text(const std::string& value) { return value.empty() ? Json() : Json(value); }

Json json(const Interval& interval) {
    return std::isnan(interval.low) ? Json() : Json{interval.low, interval.high};
}

Json json(const ClassScore& score, const ScoreIntervals::OfClass& intervals) {
    return {{"hits", score.hits},
            {"misses", score.misses},
            {"false_alarms", score.false_alarms},
            {"precision", number(score.precision())},
            {"recall", number(score.recall())},
            {"f1", number(score.f1())},
            {"precision_interval", json(intervals.precision)},
            {"recall_interval", json(intervals.recall)},
            {"f1_interval", json(intervals.f1)}};
}

Json json(const GroupTotals& group) {
    return {{"name", group.name},
            {"scans", group.scans},
            {"returns", group.scores.returns()},
            {"correct", number(group.scores.correct())},
            {"correct_interval", json(group.intervals.correct)},
            {"roi", json(group.scores.roi, group.intervals.roi)},
            {"rou", json(group.scores.rou, group.intervals.rou)}};
}

Json json(const std::vector<GroupTotals>& groups) {
    Json list = Json::array();
    for (const GroupTotals& group : groups) list.push_back(json(group));
    return list;
}

Json json(const ScoreTotals& scores) {
    return {{"all", json(scores.all)},
            {"by_range", json(scores.by_range)},
            {"by_altitude", json(scores.by_altitude)},
            {"by_kind", json(scores.by_kind)},
            {"by_folder", json(scores.by_folder)}};
}

Json json(const Latency& latency) {
    if (latency.runs == 0) return {};
    return {{"runs", latency.runs},          {"mean", number(latency.mean_ms)},
            {"sd", number(latency.sd_ms)},   {"p50", number(latency.p50_ms)},
            {"p95", number(latency.p95_ms)}, {"p99", number(latency.p99_ms)},
            {"max", number(latency.max_ms)}};
}

Json json(const Missed& missed) {
    return {
        {"missed", missed.missed}, {"of", missed.all}, {"missed_share", number(missed.share())}};
}

Json json(const std::vector<MissedGroup>& groups) {
    Json list = Json::array();
    for (const MissedGroup& group : groups) {
        Json part = json(group.missed);
        part["name"] = group.name;
        list.push_back(part);
    }
    return list;
}

Json json(const DroneTotals& drone) {
    const DroneScores& all = drone.all;
    return {{"returns_above_half_metre", json(all.tall)},
            {"returns_above_half_metre_by_range", json(drone.by_range)},
            {"returns_above_half_metre_by_kind", json(drone.by_kind)},
            {"obstacles", all.obstacles.all == 0 ? Json() : json(all.obstacles)},
            {"false_roi_on_bare_ground", all.false_on_bare_ground},
            {"false_roi_on_bare_ground_per_scan", number(all.falseOnBareGroundPerScan())}};
}

Json json(const MethodTotals& method) {
    const Json sweep{{"key", method.sweep_key}, {"value", method.sweep_value}};
    return {{"name", method.name},
            {"sweep", method.sweep_key.empty() ? Json() : sweep},
            {"latency_ms", json(method.latency)},
            {"drone", json(method.drone)},
            {"returns", json(method.returns)},
            {"pixels", method.pixels.all.scans == 0 ? Json() : json(method.pixels)}};
}

/// `recorded` holds the scores of the same method on the undegraded scans.
Json json(const MethodTotals& method, const MethodTotals& recorded) {
    const Scores &scores = method.returns.all.scores, &before = recorded.returns.all.scores;
    return {{"name", method.name},
            {"returns", json(method.returns.all)},
            {"roi_f1_change_points", number(changeInPoints(scores.roi.f1(), before.roi.f1()))},
            {"rou_f1_change_points", number(changeInPoints(scores.rou.f1(), before.rou.f1()))},
            {"drone", json(method.drone)}};
}

}  // namespace

void writeJson(const std::filesystem::path& file, const Summary& summary) {
    Json report{{"hagen", HAGEN_VERSION},
                {"compiler", __VERSION__},
                {"command_line", summary.command_line}};
    for (std::size_t f = 0; f < summary.folders.size(); ++f) {
        report["folders"].push_back({{"name", summary.folder_names[f]},
                                     {"path", summary.folders[f]},
                                     {"recovered_sensor", text(summary.sensor_texts[f])},
                                     {"settings", jsonOf(summary.folder_settings[f])},
                                     {"remarks", summary.folder_remarks[f]}});
    }
    report["settings"] = jsonOf(summary.settings);
    report["label_map"] = text(summary.label_map);
    report["camera"] = text(summary.camera);
    report["max_range_m"] = summary.range.max_range_m;
    report["scans"] = summary.scans;
    report["bootstrap"] = {{"resamples", summary.bootstrap.resamples},
                           {"seed", summary.bootstrap.seed},
                           {"level", summary.bootstrap.level}};
    report["methods"] = Json::array();
    for (const MethodTotals& method : summary.methods) report["methods"].push_back(json(method));

    report["hard_sets"] = Json::array();
    for (const HardSetTotals& set : summary.hard_sets) {
        Json methods = Json::array();
        for (std::size_t m = 0; m < set.methods.size(); ++m)
            methods.push_back(json(set.methods[m], summary.methods[m]));
        report["hard_sets"].push_back({{"name", set.name}, {"methods", methods}});
    }

    base::writeText(base::dumpJson(report, 2) + "\n", file, file);
}

}  // namespace hagen::evaluation
