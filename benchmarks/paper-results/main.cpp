// Measures what docs/results.md says, and writes it. Run by scripts/reproduce-paper.
#include <hagen/base/OutputPath.h>
#include <hagen/labelled_scans/Charts.h>
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <thread>

#include "Document.h"
#include "Figures.h"

namespace {

using namespace hagen;
namespace fs = std::filesystem;

struct Flags {
    std::string labelled, data, config, output, revision = "unknown", simulation = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(CLI::App& app, Flags& flags) {
    app.add_option("-o,--output", flags.output, "folder for results.md and the charts in results/")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--data", flags.data, "folder for simulated scans; what is there is used again")
        ->required();
    app.add_option("--config", flags.config, "the project's folder of settings files")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--labelled", flags.labelled,
                   "folder of beams16/ and beams64/, real scans with labels; without it none");
    app.add_option("--revision", flags.revision, "of the project, for the document");
    app.add_option("--simulation", flags.simulation, "of the simulation; others' scans are remade");
    app.add_flag("--quick", flags.is_quick, "a scan a flight, to see that it works");
    app.add_flag("--overwrite", flags.overwrite, "replace results that exist");
}

int run(const Flags& flags) {
    base::OutputPath document(fs::path(flags.output) / "results.md", base::kFile,
                              flags.overwrite);
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
    CLI::App app{"Measures what docs/results.md says, and writes it."};
    app.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    Flags flags;
    addFlags(app, flags);
    try {
        app.parse(argc, argv);
        return run(flags);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "paper-results: " << e.what() << "\n";
        return 1;
    }
}
