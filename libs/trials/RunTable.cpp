#include <hagen/base/NumberText.h>
#include <hagen/trials/RunTable.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <tuple>

namespace hagen::trials {
namespace {

std::string measureText(double value, int decimals) {
    if (std::isnan(value)) return "";
    return base::fixedText(value, decimals);
}

template <class Number>
Number parsed(const std::string& text) {
    if (const auto value = base::numberFrom<Number>(text)) return *value;
    throw std::runtime_error("\"" + text + "\" is no number");
}

double measureFrom(const std::string& text) { return text.empty() ? NAN : parsed<double>(text); }

template <class Value, std::size_t count>
Value wordFrom(const std::string& text, const std::array<const char*, count>& words) {
    std::string known;
    for (std::size_t w = 0; w < count; ++w) {
        if (text == words[w]) return static_cast<Value>(w);
        known += std::string(w > 0 ? ", " : "") + words[w];
    }
    throw std::runtime_error("\"" + text + "\" is none of " + known);
}

// In the order of Outcome, PoseError, and of brakes_in_known_space.
constexpr std::array<const char*, 3> kOutcomes{"success", "collision", "timeout"};
constexpr std::array<const char*, 3> kPoseErrors{"none", "noise", "drift"};
constexpr std::array<const char*, 2> kUnknowns{"optimistic", "brake_known"};

struct Column {
    const char* name;
    std::function<std::string(const Run&)> write;
    std::function<void(const std::string&, Run&)> read;
};

/// A measure that need not be there.
Column measure(const char* name, double TrialResult::*field, int decimals) {
    return {name, [=](const Run& run) { return measureText(run.result.*field, decimals); },
            [=](const std::string& text, Run& run) { run.result.*field = measureFrom(text); }};
}

Column count(const char* name, int TrialResult::*field) {
    return {name, [=](const Run& run) { return std::to_string(run.result.*field); },
            [=](const std::string& text, Run& run) {
                run.result.*field = parsed<int>(text);
            }};
}

Column setting(const char* name, double TrialSetup::*field) {
    return {name, [=](const Run& run) { return base::shortestText(run.setup.*field); },
            [=](const std::string& text, Run& run) {
                run.setup.*field = parsed<double>(text);
            }};
}

Column setting(const char* name, std::string TrialSetup::*field) {
    return {name, [=](const Run& run) { return run.setup.*field; },
            [=](const std::string& text, Run& run) { run.setup.*field = text; }};
}

Column word(const char* name, std::string Run::*field) {
    return {name, [=](const Run& run) { return run.*field; },
            [=](const std::string& text, Run& run) { run.*field = text; }};
}

const std::vector<Column>& columns() {
    static const std::vector<Column> all{
        word("scenario", &Run::scenario),
        {"seed", [](const Run& run) { return std::to_string(run.seed); },
         [](const std::string& text, Run& run) {
             run.seed = parsed<std::uint64_t>(text);
         }},
        setting("model", &TrialSetup::model),
        setting("guidance", &TrialSetup::guidance),
        setting("speed", &TrialSetup::speed_m_s),
        {"outcome", [](const Run& run) { return nameOf(run.result.outcome); },
         [](const std::string& text, Run& run) {
             run.result.outcome = wordFrom<Outcome>(text, kOutcomes);
         }},
        measure("min_clearance_m", &TrialResult::min_clearance_m, 4),
        measure("path_m", &TrialResult::path_m, 3),
        measure("time_s", &TrialResult::time_s, 3),
        setting("planner", &TrialSetup::planner),
        {"pose_error", [](const Run& run) { return nameOf(run.setup.pose_error); },
         [](const std::string& text, Run& run) {
             run.setup.pose_error = wordFrom<PoseError>(text, kPoseErrors);
         }},
        setting("latency_scale", &TrialSetup::latency_scale),
        {"unknown",
         [](const Run& run) { return kUnknowns[run.setup.brakes_in_known_space ? 1 : 0]; },
         [](const std::string& text, Run& run) {
             run.setup.brakes_in_known_space = wordFrom<int>(text, kUnknowns) == 1;
         }},
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
        word("version", &Run::version)};
    return all;
}

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

}  // namespace

std::string nameOf(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }

std::string nameOf(PoseError error) { return kPoseErrors[static_cast<std::size_t>(error)]; }

PoseError poseErrorFrom(const std::string& name) {
    try {
        return wordFrom<PoseError>(name, kPoseErrors);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("pose error: ") + e.what());
    }
}

std::string runHeader() {
    std::string header;
    for (const Column& column : columns())
        header += (header.empty() ? "" : ",") + std::string(column.name);
    return header;
}

std::string rowOf(const Run& run) {
    std::string row;
    for (const Column& column : columns()) {
        if (!row.empty()) row += ',';
        row += column.write(run);
    }
    return row;
}

Run runOf(const std::string& row) {
    const std::vector<std::string> fields = fieldsOf(row);
    if (fields.size() != columns().size()) {
        throw std::runtime_error(std::to_string(fields.size()) + " fields, not " +
                                 std::to_string(columns().size()));
    }
    Run run{};
    for (std::size_t c = 0; c < fields.size(); ++c) {
        try {
            columns()[c].read(fields[c], run);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(std::string("column ") + columns()[c].name + ": " + e.what());
        }
    }
    return run;
}

std::vector<Run> readRuns(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
    const auto fail = [&](int line, const std::string& what) {
        throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
    };
    std::vector<Run> runs;
    std::string text;
    int line = 0;
    while (std::getline(in, text)) {
        ++line;
        if (!text.empty() && text.back() == '\r') text.pop_back();
        if (line == 1) {
            if (text != runHeader())
                fail(line, "not the header of runs; it must be " + runHeader());
            continue;
        }
        try {
            runs.push_back(runOf(text));
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
                        s.latency_scale, s.brakes_in_known_space, run.settings_hash, run.version,
                        run.seed);
    };
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const Run& a, const Run& b) { return key(a) < key(b); });
}

}  // namespace hagen::trials
