// Times the complete filter and each stage on sequences of scans, and counts allocations. For
// comparison, times MRPT's own decoder and a published ground segmenter. Run by scripts/benchmark.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <regex>

#include "StageRows.h"
#include "TimedRows.h"
#include "base/command_line/CommandLine.h"
#include "support/Allocations.h"

namespace {

using namespace hagen;

struct Flags {
    std::string json, filter = ".";
    int scans = 13;
    std::size_t runs = 104;
};

/// A row and its measurements.
struct Runs {
    StageRow row;
    std::size_t allocations = 0;
    std::vector<double> warm_ms = {}, cold_ms = {};

    void time(Case& one, std::vector<double>& to_ms) {
        const std::size_t before = hagen::allocations();
        const auto start = std::chrono::steady_clock::now();
        row.run(one);
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        allocations += hagen::allocations() - before;
        to_ms.push_back(took.count());
    }
};

/// Timed rows that share a case.
struct Group {
    Case one;
    std::vector<Runs> rows;
};

/// Makes the rows, and runs each once on each scan, which allocates all memory.
std::vector<Group> groupsOf(const std::vector<StageGroup>& asked, const Input& input) {
    std::vector<Group> groups;
    for (const StageGroup& group : asked) {
        if (group.rows.front().what == kMrptDecode && input.packets.empty()) continue;
        Group& to = groups.emplace_back(Group{Case(input, group.options), {}});
        for (const StageRow& row : group.rows) to.rows.push_back({row});
        for (std::size_t scan = 0; scan < input.size(); ++scan) {
            to.one.loadResults(scan);
            for (const StageRow& row : group.rows) row.run(to.one);
        }
    }
    return groups;
}

/// Evicts data from the caches by reading other data.
void flushCaches() {
    static const std::vector<char> buffer(std::size_t{1} << 28, 1);
    const volatile char* const bytes = buffer.data();
    for (std::size_t i = 0; i < buffer.size(); i += 64) static_cast<void>(bytes[i]);
}

/// Runs all pipelines in turn on each scan, so that other load affects all of them. Each has just
/// labelled the previous scan (warm), or the caches are flushed (cold).
void timePipelines(std::vector<Group>& groups, std::size_t runs) {
    for (const bool is_cold : {false, true}) {
        for (std::size_t run = 0; run < runs; ++run) {
            for (std::size_t g = 0; g < groups.size(); ++g) {
                auto& [one, rows] = groups[(run + g) % groups.size()];
                one.load(run % one.input->size());
                rows.front().row.run(one);
                one.load((run + 1) % one.input->size());
                if (is_cold) flushCaches();
                rows.front().time(one, is_cold ? rows.front().cold_ms : rows.front().warm_ms);
            }
        }
    }
}

/// Runs all stages in turn on each scan.
void timeStages(std::vector<Group>& groups, std::size_t runs) {
    for (std::size_t run = 0; run < runs; ++run) {
        for (auto& [one, rows] : groups) {
            one.loadResults(run % one.input->size());
            for (Runs& row : rows) row.time(one, row.warm_ms);
        }
    }
}

struct Sensor {
    std::string name;
    bool with_stages;
    std::function<Input()> input;
};

std::vector<Sensor> sensorsFor(const Flags& flags) {
    std::vector<Sensor> sensors{
        {"VLP-16", true, [&] { return simulatedPackets("VLP-16", flags.scans); }},
        {"HDL-32E", false, [&] { return simulatedPackets("HDL-32E", flags.scans); }},
        {"HDL-64E", true, [&] { return realScansOf64Beams(flags.scans); }},
        {"OS1-128/1024", false, [&] { return simulatedOs1(1024, flags.scans); }},
        {"OS1-128/2048", true, [&] { return simulatedOs1(2048, flags.scans); }}};
    if (std::getenv("HAGEN_LABELLED_DATA") == nullptr) {
        std::cerr << "HDL-64E: skipped, HAGEN_LABELLED_DATA is not set\n";
        sensors.erase(sensors.begin() + 2);
    }
    return sensors;
}

std::vector<StageGroup> matching(const Flags& flags, const std::string& sensor,
                                 const std::vector<StageGroup>& groups) {
    const std::regex filter(flags.filter);
    std::vector<StageGroup> some;
    for (const StageGroup& group : groups) {
        StageGroup to{group.options, {}};
        for (const StageRow& row : group.rows) {
            if (std::regex_search(sensor + "/" + row.what, filter)) to.rows.push_back(row);
        }
        if (!to.rows.empty()) some.push_back(to);
    }
    return some;
}

int run(const Flags& flags) {
    std::vector<TimedRow> rows;
    for (const Sensor& sensor : sensorsFor(flags)) {
        const auto whole = matching(flags, sensor.name, pipelines());
        const auto parts =
            matching(flags, sensor.name, sensor.with_stages ? stages() : std::vector<StageGroup>());
        if (whole.empty() && parts.empty()) continue;
        std::cerr << sensor.name << "\n";
        const Input input = sensor.input();
        for (const auto& [asked, time] : {std::pair(whole, &timePipelines), {parts, &timeStages}}) {
            std::vector<Group> groups = groupsOf(asked, input);
            time(groups, flags.runs);
            for (const Group& group : groups) {
                for (const Runs& row : group.rows) {
                    const auto runs = static_cast<double>(row.warm_ms.size() + row.cold_ms.size());
                    rows.push_back({sensor.name, row.row.what, input.model.rows() * input.columns,
                                    evaluation::latencyOf(row.warm_ms),
                                    evaluation::latencyOf(row.cold_ms),
                                    static_cast<double>(row.allocations) / runs});
                }
            }
        }
    }
    std::cout << tableOf(rows);
    if (!flags.json.empty()) {
        std::ofstream out(flags.json);
        out << jsonOf(rows);
        out.close();
        if (!out) throw std::runtime_error(flags.json + ": cannot be written");
    }
    return base::kDone;
}

}  // namespace

int main(int argc, char** argv) {
    base::Program app("stage-benchmarks", "Times the filter and its stages.");
    Flags flags;
    app.option("--json", flags.json, "JSON file for the results");
    app.option("--filter", flags.filter, "rows, as a regular expression for SENSOR/ROW")
        .showDefault();
    app.option("--scans", flags.scans, "consecutive scans in each scene").positive().showDefault();
    app.option("--runs", flags.runs, "timed runs per row").positive().showDefault();
    return app.run(argc, argv, [&] { return run(flags); });
}
