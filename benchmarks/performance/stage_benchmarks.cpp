// Times each stage and the complete filter, and counts allocations. For comparison, times MRPT's
// own decoder, a published ground segmenter, and a lower bound for any method. Run by
// scripts/benchmark.
#include <benchmark/benchmark.h>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "StageRows.h"
#include "TimedRows.h"
#include "support/Allocations.h"

namespace {

using namespace hagen;

/// The measurements of a row.
struct Runs {
    std::string sensor, what;
    std::vector<double> runs_ms;
    std::size_t allocations = 0;
};

/// The rows in insertion order; filled during the benchmarks.
std::vector<std::unique_ptr<Runs>>& measured() {
    static std::vector<std::unique_ptr<Runs>> rows;
    return rows;
}

/// Runs the scans in turn, and times each separately.
void time(benchmark::State& state, const StageRow& row, std::vector<Case>& cases, Runs& to) {
    for (Case& one : cases) row.run(one);  // allocates all memory
    to.runs_ms.reserve(to.runs_ms.size() + static_cast<std::size_t>(state.max_iterations));
    std::size_t next = 0;
    for (auto _ : state) {
        const std::size_t before = allocations();
        const auto start = std::chrono::steady_clock::now();
        row.run(cases[next]);
        benchmark::ClobberMemory();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        to.allocations += allocations() - before;
        state.SetIterationTime(took.count());
        to.runs_ms.push_back(1e3 * took.count());
        next = (next + 1) % cases.size();
    }
}

using Cases = std::shared_ptr<std::vector<Case>>;

Cases casesOf(const Input& input, const Options& options) {
    auto cases = std::make_shared<std::vector<Case>>();
    for (std::size_t scan = 0; scan < input.size(); ++scan) {
        cases->emplace_back(input, scan, options);
    }
    return cases;
}

void add(const StageRow& row, const std::string& sensor, const Cases& cases) {
    measured().push_back(std::make_unique<Runs>(Runs{sensor, row.what, {}, 0}));
    Runs& to = *measured().back();
    benchmark::RegisterBenchmark(
        (sensor + "/" + row.what).c_str(),
        [&row, cases, &to](benchmark::State& state) { time(state, row, *cases, to); })
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
}

void addSensor(const Input& input) {
    const Cases papers = casesOf(input, paperOptions()), ours = casesOf(input, Options());
    for (const StageRow& row : stageRows()) {
        if (row.needs_packets && input.packets.empty()) continue;
        add(row, input.sensor, row.with_paper_settings ? papers : ours);
    }
}

/// Adds the two pipelines for an image size.
void addGrid(int beams, int columns) {
    const Input input = gridScan(beams, columns);
    for (const StageRow& row : stageRows()) {
        if (row.what != "paper pipeline" && row.what != "default pipeline") continue;
        Options options = row.with_paper_settings ? paperOptions() : Options();
        options.columns = columns;
        add(row, input.sensor, casesOf(input, options));
    }
}

void addAll() {
    addSensor(realVlp16());
    for (const char* sensor : {"VLP-16", "HDL-32E", "HDL-64E"}) addSensor(simulatedScans(sensor));
    for (const int columns : {435, 870, 1740, 3480}) addGrid(16, columns);
    for (const int beams : {32, 64, 128}) addGrid(beams, 870);
}

std::vector<TimedRow> results() {
    std::vector<TimedRow> rows;
    for (const auto& row : measured()) {
        if (row->runs_ms.empty()) continue;
        rows.push_back(
            {row->sensor, row->what, evaluation::latencyOf(row->runs_ms),
             static_cast<double>(row->allocations) / static_cast<double>(row->runs_ms.size())});
    }
    return rows;
}

/// Prints nothing, and stores the results in measured().
class Silent : public benchmark::BenchmarkReporter {
 public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>&) override {}
};

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    std::string json;
    if (argc == 3 && std::string(argv[1]) == "--json") {
        json = argv[2];
        argc = 1;
    }
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    try {
        addAll();
        Silent silent;
        benchmark::RunSpecifiedBenchmarks(&silent);
        std::cout << tableOf(results());
        if (!json.empty()) {
            std::ofstream out(json);
            out << jsonOf(results());
            out.close();
            if (!out) throw std::runtime_error(json + ": cannot be written");
        }
        return 0;
    } catch (const std::exception& e) {
        std::cerr << "stage-benchmarks: " << e.what() << "\n";
        return 1;
    }
}
