// Measures the results in docs/results.md and writes that page. Run by scripts/reproduce-paper.
#include <hagen/base/OutputPath.h>
#include <hagen/labelled_scans/Charts.h>
#include <fstream>
#include <iostream>
#include <thread>

#include <hagen/command_line/CommandLine.h>
#include "Document.h"
#include "Figures.h"

namespace {

using namespace hagen;
using namespace hagen::command_line;
namespace fs = std::filesystem;

struct Flags {
    std::string labelled, data, config, output, revision = "unknown", simulation = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(Command& app, Flags& flags) {
    app.option("-o,--output", flags.output, "folder for results.md and the charts in results/")
        .required()
        .existingFolder();
    app.option("--data", flags.data, "folder for simulated scans; existing scans are reused")
        .required();
    app.option("--config", flags.config, "the project's folder of settings files")
        .required()
        .existingFolder();
    app.option("--labelled", flags.labelled,
               "folder with beams16/ and beams64/: labelled real scans (default: none)");
    app.option("--revision", flags.revision, "revision of the project, for the document");
    app.option("--simulation", flags.simulation,
               "version of the simulation; scans of other versions are simulated again");
    app.flag("--quick", flags.is_quick, "one scan per flight, to check that it works");
    app.flag("--overwrite", flags.overwrite, "replace existing results");
}

int run(const Flags& flags) {
    base::OutputPath document(fs::path(flags.output) / "results.md", base::kFile, flags.overwrite);
    base::OutputPath charts(fs::path(flags.output) / "results", labelled_scans::kCharts,
                            flags.overwrite);
    Provenance provenance{flags.revision, {101, 102, 103, 104, 105, 106}, flags.is_quick};
    SimulationSize size{provenance.seeds, 4};
    if (flags.is_quick) {
        provenance.seeds = {101};
        size = {provenance.seeds, 1};
    }
    const std::vector<DataSet> sets = dataSets(flags.labelled, flags.data, size);
    const MeasurementOptions options{flags.config, flags.simulation,
                                     std::max(1u, std::thread::hardware_concurrency())};
    const std::vector<Measured> scores = measureScores(sets, options);
    const std::vector<Measured> times = measureTimes(sets, options);

    fs::create_directory(charts.temporary());
    drawResults(charts.temporary(), scores, times);
    const std::string text = documentOf(scores, times, provenance);
    std::ofstream out(document.temporary());
    out << text;
    out.close();
    if (!out) {
        throw std::runtime_error(document.path().string() +
                                 ": cannot be written; is the disk full?");
    }
    charts.commit();
    document.commit();
    std::cout << text;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Program program("paper-results", "Measures what docs/results.md says, and writes it.");
    program.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    Flags flags;
    addFlags(program, flags);
    return program.run(argc, argv, [&] { return run(flags); });
}
