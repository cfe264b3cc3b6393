// Measures the results in docs/results.md and writes that page. Run by scripts/reproduce-paper.
#include <hagen/base/OutputPath.h>
#include <iostream>
#include <thread>
#include "base/WriteFile.h"
#include "evaluation/labelled_folders/Charts.h"

#include "Document.h"
#include "Figures.h"
#include "base/command_line/CommandLine.h"

namespace {

using namespace hagen;
using namespace hagen::base;
namespace fs = std::filesystem;

struct Flags {
    std::string labelled, data, config, output, selection;
    std::string revision = "unknown", simulation = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(Command& app, Flags& flags) {
    app.option("-o,--output", flags.output,
               "folder for results.md, and results/ with charts and tables")
        .required()
        .existingFolder();
    app.option("--data", flags.data, "folder for simulated scans; existing scans are reused")
        .required();
    app.option("--config", flags.config, "the project's folder of settings files")
        .required()
        .existingFolder();
    app.option("--labelled", flags.labelled,
               "folder with beams16/ and beams64/: labelled real scans (optional)");
    app.option("--selection", flags.selection, "record of scripts/select-settings (optional)")
        .existingFile();
    app.option("--revision", flags.revision, "revision of the project, for the document");
    app.option("--simulation", flags.simulation,
               "version of the simulation; scans of other versions are simulated again");
    app.flag("--quick", flags.is_quick, "one scan per flight, for testing");
    app.flag("--overwrite", flags.overwrite, "replace existing results");
}

/// A folder that contains charts and tables.
constexpr base::OutputKind kFigures{"a folder of charts and tables", [](const fs::path& within) {
                                        return within.extension() == ".csv" ||
                                               evaluation::kCharts.holds(within);
                                    }};

int run(const Flags& flags) {
    base::OutputPath document(fs::path(flags.output) / "results.md", base::kFile, flags.overwrite);
    base::OutputPath charts(fs::path(flags.output) / "results", kFigures, flags.overwrite);
    Provenance provenance{flags.revision, {101, 102, 103, 104, 105, 106}, flags.is_quick, {}};
    if (!flags.selection.empty()) provenance.selection = selection::readRecord(flags.selection);
    SimulationSize size{provenance.seeds, 4};
    if (flags.is_quick) {
        provenance.seeds = {101};
        size = {provenance.seeds, 1};
    }
    const std::vector<DataSet> sets = dataSets(flags.labelled, flags.data, size);
    const MeasurementOptions options{flags.config, flags.simulation,
                                     std::max(1u, std::thread::hardware_concurrency())};
    std::vector<Measured> scores = measureScores(sets, options);
    measureHardSets(scores, options);
    const std::vector<Measured> times = measureTimes(sets, options);

    fs::create_directory(charts.temporary());
    drawResults(charts.temporary(), scores, times);
    for (const auto& [name, table] : tablesOf(scores, times, provenance)) {
        base::writeText(table, charts.temporary() / name, charts.path() / name);
    }
    const std::string text = documentOf(scores, times, provenance);
    base::writeText(text, document.temporary(), document.path());
    charts.commit();
    document.commit();
    std::cout << text;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Program program("paper-results", "Measures and writes docs/results.md.");
    program.footer("Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    Flags flags;
    addFlags(program, flags);
    return program.run(argc, argv, [&] { return run(flags); });
}
