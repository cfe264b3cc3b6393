#include "avoidance/flights/RunTable.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <tuple>
#include "base/NumberText.h"
#include "base/ReadFile.h"
#include "base/Text.h"

namespace hagen::avoidance {
namespace {

/// A column of runs.csv.
struct RunColumn {
    const char* name;
    std::function<std::string(const Run&)> write;
    std::function<void(const std::string&, Run&)> read;  ///< throws on invalid text
    bool is_key = false;                                 ///< identifies a run
};

/// Formats a number; NaN becomes an empty field.
std::string measureText(double value, int decimals) {
    return std::isnan(value) ? "" : base::fixedText(value, decimals);
}

template <class Number>
Number numberFrom(const std::string& text) {
    if (const auto value = base::numberFrom<Number>(text)) return *value;
    throw std::runtime_error("\"" + text + "\" is not a number");
}

double measureFrom(const std::string& text) {
    if (text.empty()) return NAN;
    const auto value = numberFrom<double>(text);
    if (!std::isfinite(value)) throw std::runtime_error("\"" + text + "\" is not finite");
    return value;
}

bool brakesFrom(const std::string& text) {
    if (text == "brake_known") return true;
    if (text == "optimistic") return false;
    throw std::runtime_error("\"" + text + "\" is not one of optimistic, brake_known");
}

RunColumn key(RunColumn column) {
    column.is_key = true;
    return column;
}

RunColumn measure(const char* name, double TrialResult::*field, int decimals) {
    return {name, [=](const Run& run) { return measureText(run.result.*field, decimals); },
            [=](const std::string& text, Run& run) { run.result.*field = measureFrom(text); }};
}

RunColumn count(const char* name, int TrialResult::*field) {
    return {name, [=](const Run& run) { return std::to_string(run.result.*field); },
            [=](const std::string& text, Run& run) { run.result.*field = numberFrom<int>(text); }};
}

RunColumn setting(const char* name, double TrialSetup::*field, double min = 0) {
    constexpr double kMax = 100;  // same limit as in CampaignPlan
    return {name, [=](const Run& run) { return base::shortestText(run.setup.*field); },
            [=](const std::string& text, Run& run) {
                const auto value = numberFrom<double>(text);
                if (!(value > 0 && value <= kMax)) {
                    throw std::runtime_error("\"" + text + "\" is not above 0 and at most 100");
                }
                if (value < min) throw std::runtime_error("\"" + text + "\" is too small");
                run.setup.*field = value;
            }};
}

RunColumn setting(const char* name, std::string TrialSetup::*field) {
    return {name, [=](const Run& run) { return run.setup.*field; },
            [=](const std::string& text, Run& run) { run.setup.*field = text; }};
}

template <class Value>
RunColumn condition(const char* name, Value TrialSetup::*field, Value (*from)(const std::string&)) {
    return {name, [=](const Run& run) { return nameOf(run.setup.*field); },
            [=](const std::string& text, Run& run) { run.setup.*field = from(text); }};
}

RunColumn word(const char* name, std::string Run::*field) {
    return {name, [=](const Run& run) { return run.*field; },
            [=](const std::string& text, Run& run) { run.*field = text; }};
}

/// In table order.
const std::vector<RunColumn>& allColumns() {
    static const std::vector<RunColumn> all{
        key(word("scenario", &Run::scenario)),
        key({"seed", [](const Run& run) { return std::to_string(run.seed); },
             [](const std::string& text, Run& run) {
                 run.seed = numberFrom<std::uint64_t>(text);
             }}),
        key(setting("model", &TrialSetup::model)),
        key(setting("guidance", &TrialSetup::guidance)),
        key(setting("speed", &TrialSetup::speed_m_s, 0.1)),
        {"outcome", [](const Run& run) { return nameOf(run.result.outcome); },
         [](const std::string& text, Run& run) { run.result.outcome = outcomeFrom(text); }},
        measure("min_clearance_m", &TrialResult::min_clearance_m, 4),
        measure("path_m", &TrialResult::path_m, 3),
        measure("time_s", &TrialResult::time_s, 3),
        key(setting("planner", &TrialSetup::planner)),
        key(condition("pose_error", &TrialSetup::pose_error, poseErrorFrom)),
        key(setting("latency_scale", &TrialSetup::latency_scale)),
        key({"unknown",
             [](const Run& run) {
                 return run.setup.brakes_in_known_space ? "brake_known" : "optimistic";
             },
             [](const std::string& text, Run& run) {
                 run.setup.brakes_in_known_space = brakesFrom(text);
             }}),
        {"oracle_path_m", [](const Run& run) { return measureText(run.oracle_path_m, 3); },
         [](const std::string& text, Run& run) { run.oracle_path_m = measureFrom(text); }},
        measure("first_reaction_m", &TrialResult::first_reaction_m, 3),
        measure("rms_jerk_m_s3", &TrialResult::rms_jerk_m_s3, 3),
        count("scans", &TrialResult::scans),
        count("dropped_scans", &TrialResult::dropped_scans),
        count("emergency_stops", &TrialResult::emergency_stops),
        measure("latency_p50_ms", &TrialResult::latency_p50_ms, 3),
        measure("latency_p95_ms", &TrialResult::latency_p95_ms, 3),
        measure("latency_max_ms", &TrialResult::latency_max_ms, 3),
        word("settings", &Run::settings_hash),
        word("version", &Run::version),
        key(condition("air", &TrialSetup::air, airFrom)),
        key(condition("distance", &TrialSetup::distance, distanceFrom)),
        key(condition("updates", &TrialSetup::updates, updatesFrom))};
    return all;
}

using Columns = std::vector<const RunColumn*>;

Columns columnsOf(bool keys_only = false) {
    Columns columns;
    for (const RunColumn& column : allColumns()) {
        if (column.is_key || !keys_only) columns.push_back(&column);
    }
    return columns;
}

std::string headerOf(const Columns& columns) {
    std::vector<std::string> names;
    for (const RunColumn* column : columns) names.emplace_back(column->name);
    return base::joined(names, ",");
}

std::string fieldsOf(const Run& run, const Columns& columns) {
    std::string fields;
    for (const RunColumn* column : columns) {
        if (!fields.empty()) fields += ',';
        fields += column->write(run);
    }
    return fields;
}

Run runFrom(const std::string& line, const Columns& columns) {
    const std::vector<std::string> fields = base::split(line, ',');
    if (fields.size() != columns.size()) {
        throw std::runtime_error(std::to_string(fields.size()) + " fields, not " +
                                 std::to_string(columns.size()));
    }
    Run run{};
    for (std::size_t c = 0; c < fields.size(); ++c) {
        try {
            columns[c]->read(fields[c], run);
        } catch (const std::exception& e) {
            throw std::runtime_error(std::string("column ") + columns[c]->name + ": " + e.what());
        }
    }
    return run;
}

}  // namespace

std::string runHeader() { return headerOf(columnsOf()); }

std::string rowOf(const Run& run) { return fieldsOf(run, columnsOf()); }

std::string keyOf(const Run& run) { return fieldsOf(run, columnsOf(true)); }

Run runOfKey(const std::string& key) { return runFrom(key, columnsOf(true)); }

std::vector<Run> readRuns(const std::filesystem::path& file) {
    std::ifstream in = base::openToRead(file);
    const auto fail = [&](int line, const std::string& what) {
        throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
    };
    std::vector<Run> runs;
    const Columns columns = columnsOf();
    std::string text;
    int line = 0;
    while (base::nextLine(in, text, file)) {
        ++line;
        if (!text.empty() && text.back() == '\r') text.pop_back();
        if (line == 1) {
            if (text != runHeader()) fail(line, "wrong header; expected " + runHeader());
            continue;
        }
        try {
            runs.push_back(runFrom(text, columns));
        } catch (const std::runtime_error& e) {
            fail(line, e.what());
        }
    }
    if (in.bad()) throw std::runtime_error(file.string() + ": cannot be read");
    if (line == 0) fail(1, "is empty; it must begin with " + runHeader());
    return runs;
}

void sortRuns(std::vector<Run>& runs) {
    const auto key = [](const Run& run) {
        const TrialSetup& s = run.setup;
        return std::tie(run.scenario, s.speed_m_s, s.planner, s.guidance, s.model, s.pose_error,
                        s.latency_scale, s.brakes_in_known_space, s.air, s.distance, s.updates,
                        run.settings_hash, run.version, run.seed);
    };
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const Run& a, const Run& b) { return key(a) < key(b); });
}

}  // namespace hagen::avoidance
