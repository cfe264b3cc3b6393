#include "avoidance/flights/RunColumns.h"

#include <cmath>
#include <stdexcept>

#include "avoidance/flights/CsvNumbers.h"
#include "avoidance/flights/Words.h"

namespace hagen::avoidance {
namespace {

double measureFrom(const std::string& text) {
    if (text.empty()) return NAN;
    const auto value = parsedNumber<double>(text);
    if (!std::isfinite(value)) throw std::runtime_error("\"" + text + "\" is not finite");
    return value;
}

RunColumn key(RunColumn column, const std::string& before = "") {
    column.is_key = true;
    column.before = before;
    return column;
}

RunColumn optional(RunColumn column) {
    column.is_optional = true;
    return column;
}

/// A measure; NaN is an empty field.
RunColumn measure(const char* name, double TrialResult::*field, int decimals) {
    return {name, [=](const Run& run) { return measureText(run.result.*field, decimals); },
            [=](const std::string& text, Run& run) { run.result.*field = measureFrom(text); }};
}

RunColumn count(const char* name, int TrialResult::*field) {
    return {
        name, [=](const Run& run) { return std::to_string(run.result.*field); },
        [=](const std::string& text, Run& run) { run.result.*field = parsedNumber<int>(text); }};
}

constexpr double kMostSetting = 100;  // as of a plan; an absurd flight takes for ever

RunColumn setting(const char* name, double TrialSetup::*field, double least = 0) {
    return {name, [=](const Run& run) { return base::shortestText(run.setup.*field); },
            [=](const std::string& text, Run& run) {
                const auto value = parsedNumber<double>(text);
                if (!(value > 0 && value <= kMostSetting)) {
                    throw std::runtime_error("\"" + text + "\" is not above 0 and at most 100");
                }
                if (value < least) throw std::runtime_error("\"" + text + "\" is too little");
                run.setup.*field = value;
            }};
}

RunColumn setting(const char* name, std::string TrialSetup::*field) {
    return {name, [=](const Run& run) { return run.setup.*field; },
            [=](const std::string& text, Run& run) { run.setup.*field = text; }};
}

RunColumn word(const char* name, std::string Run::*field) {
    return {name, [=](const Run& run) { return run.*field; },
            [=](const std::string& text, Run& run) { run.*field = text; }};
}

}  // namespace

const std::vector<RunColumn>& runColumns() {
    static const std::vector<RunColumn> all{
        key(word("scenario", &Run::scenario)),
        key({"seed", [](const Run& run) { return std::to_string(run.seed); },
             [](const std::string& text, Run& run) {
                 run.seed = parsedNumber<std::uint64_t>(text);
             }}),
        key(setting("model", &TrialSetup::model)),
        key(setting("guidance", &TrialSetup::guidance)),
        key(setting("speed", &TrialSetup::speed_m_s, 0.1)),
        {"outcome", [](const Run& run) { return nameOf(run.result.outcome); },
         [](const std::string& text, Run& run) {
             run.result.outcome = wordFrom<Outcome>(text, kOutcomes);
         }},
        measure("min_clearance_m", &TrialResult::min_clearance_m, 4),
        measure("path_m", &TrialResult::path_m, 3),
        measure("time_s", &TrialResult::time_s, 3),
        key(setting("planner", &TrialSetup::planner)),
        key({"pose_error", [](const Run& run) { return nameOf(run.setup.pose_error); },
             [](const std::string& text, Run& run) {
                 run.setup.pose_error = wordFrom<PoseError>(text, kPoseErrors);
             }}),
        key(setting("latency_scale", &TrialSetup::latency_scale)),
        key({"unknown",
             [](const Run& run) { return kUnknowns[run.setup.brakes_in_known_space ? 1 : 0]; },
             [](const std::string& text, Run& run) {
                 run.setup.brakes_in_known_space = wordFrom<int>(text, kUnknowns) == 1;
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
        key({"air", [](const Run& run) { return nameOf(run.setup.air); },
             [](const std::string& text, Run& run) { run.setup.air = wordFrom<Air>(text, kAirs); }},
            kAirs[1]),
        key({"distance", [](const Run& run) { return nameOf(run.setup.distance); },
             [](const std::string& text, Run& run) {
                 run.setup.distance = wordFrom<ModelDistance>(text, avoidance::kModelDistances);
             }},
            avoidance::kModelDistances[1]),
        optional(key({"updates", [](const Run& run) { return nameOf(run.setup.updates); },
                      [](const std::string& text, Run& run) {
                          run.setup.updates = wordFrom<Updates>(text, kUpdates);
                      }},
                     kUpdates[0]))};
    return all;
}

}  // namespace hagen::avoidance
