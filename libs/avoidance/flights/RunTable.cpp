#include <hagen/avoidance/RunTable.h>
#include <hagen/base/ReadFile.h>
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <tuple>

#include "avoidance/flights/RunColumns.h"

namespace hagen::avoidance {
namespace {

using Columns = std::vector<const RunColumn*>;

Columns columnsThat(bool (*fit)(const RunColumn&)) {
    Columns columns;
    for (const RunColumn& column : runColumns()) {
        if (fit(column)) columns.push_back(&column);
    }
    return columns;
}

const Columns& allColumns() {
    static const Columns columns = columnsThat([](const RunColumn&) { return true; });
    return columns;
}

const Columns& rowColumns() {
    static const Columns columns =
        columnsThat([](const RunColumn& one) { return !one.is_optional; });
    return columns;
}

const Columns& allKeyColumns() {
    static const Columns columns = columnsThat([](const RunColumn& one) { return one.is_key; });
    return columns;
}

const Columns& keyColumns() {
    static const Columns columns =
        columnsThat([](const RunColumn& one) { return one.is_key && !one.is_optional; });
    return columns;
}

std::string headerOf(const Columns& columns) {
    std::string header;
    for (const RunColumn* column : columns) {
        header += (header.empty() ? "" : ",") + std::string(column->name);
    }
    return header;
}

std::string fieldsOf(const Run& run, const Columns& columns) {
    std::string fields;
    for (const RunColumn* column : columns) {
        if (!fields.empty()) fields += ',';
        fields += column->write(run);
    }
    return fields;
}

std::vector<std::string> split(const std::string& line) {
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

Run runFrom(const std::string& line, const Columns& columns) {
    const std::vector<std::string> fields = split(line);
    if (fields.size() != columns.size()) {
        throw std::runtime_error(std::to_string(fields.size()) + " fields, not " +
                                 std::to_string(columns.size()));
    }
    Run run{};
    for (std::size_t c = 0; c < fields.size(); ++c) {
        try {
            columns[c]->read(fields[c], run);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(std::string("column ") + columns[c]->name + ": " + e.what());
        }
    }
    return run;
}

std::size_t fieldsIn(const std::string& line) {
    return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

/// The columns of a table by its header. Older tables lack the last ones. None: it is no table.
Columns columnsOf(const std::string& header) {
    Columns columns = allColumns();
    while (headerOf(columns) != header) {
        if (columns.empty() || columns.back()->before.empty()) return {};
        columns.pop_back();
    }
    return columns;
}

/// The run of a row with some of the columns.
Run runOfOlder(const std::string& row, const Columns& columns) {
    Run run = runFrom(row, columns);
    for (std::size_t c = columns.size(); c < allColumns().size(); ++c) {
        allColumns()[c]->read(allColumns()[c]->before, run);
    }
    return run;
}

}  // namespace

std::string runHeader() { return headerOf(rowColumns()); }
std::string rowOf(const Run& run) {
    return fieldsOf(run, needsAllColumns(run) ? allColumns() : rowColumns());
}

bool needsAllColumns(const Run& run) {
    return std::any_of(allColumns().begin(), allColumns().end(), [&](const RunColumn* one) {
        return one->is_optional && one->write(run) != one->before;
    });
}
std::string fullRunHeader() { return headerOf(allColumns()); }
std::string fullRowOf(const Run& run) { return fieldsOf(run, allColumns()); }

std::string keyOf(const Run& run) {
    return fieldsOf(run, needsAllColumns(run) ? allKeyColumns() : keyColumns());
}
Run runOfKey(const std::string& key) {
    const bool is_full = fieldsIn(key) == allKeyColumns().size();
    return runFrom(key, is_full ? allKeyColumns() : keyColumns());
}

std::vector<Run> readRuns(const std::filesystem::path& file) {
    std::ifstream in = base::openToRead(file);
    const auto fail = [&](int line, const std::string& what) {
        throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
    };
    std::vector<Run> runs;
    Columns columns;
    std::string text;
    int line = 0;
    while (base::nextLine(in, text, file)) {
        ++line;
        if (!text.empty() && text.back() == '\r') text.pop_back();
        if (line == 1) {
            columns = columnsOf(text);
            if (columns.empty()) fail(line, "not the header of runs; it must be " + runHeader());
            continue;
        }
        try {
            runs.push_back(runOfOlder(text, columns));
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
