// Times whole flights, and writes docs/performance.md of that and of what stage-benchmarks and
// conversion-benchmark measured. Run by scripts/measure-performance.
#include <hagen/base/OutputPath.h>
#include <hagen/labelled_scans/Charts.h>
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "Document.h"
#include "StageRows.h"

namespace {

using namespace hagen;
namespace fs = std::filesystem;

struct Flags {
    std::string output, stages, conversion, revision = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(CLI::App& app, Flags& flags) {
    app.add_option("-o,--output", flags.output,
                   "folder for performance.md and the figure in performance/")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--stages", flags.stages, "what stage-benchmarks --json wrote")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("--conversion", flags.conversion, "what conversion-benchmark --json wrote")
        ->check(CLI::ExistingFile);
    app.add_option("--revision", flags.revision, "of the project, for the document");
    app.add_flag("--quick", flags.is_quick, "few scans, to see that it works");
    app.add_flag("--overwrite", flags.overwrite, "replace results that exist");
}

Performance measure(const Flags& flags) {
    Performance p;
    p.revision = flags.revision;
    p.is_quick = flags.is_quick;
    p.rows = readTimedRows(flags.stages);
    if (!flags.conversion.empty()) p.conversions = readConversionTimes(flags.conversion);
    const int scale = flags.is_quick ? 50 : 1;
    for (const auto& [name, options] :
         {std::pair<std::string, Options>{"paper", paperOptions()}, {"default", Options()}}) {
        p.packets_to_labels.push_back(
            {name, evaluation::latencyOf(packetsToLabels_ms(options, 10000 / scale))});
    }
    p.table = timeFlight("orchard", 1, 1500 / scale);
    std::cerr << "timed: orchard\n";
    for (const char* scenario : {"street", "forest-0.05", "field"}) {
        p.chart.push_back(timeFlight(scenario, 1, 1000 / scale));
        std::cerr << "timed: " << scenario << "\n";
    }
    return p;
}

void run(const Flags& flags) {
    base::OutputPath document(fs::path(flags.output) / "performance.md",
                              base::kFile, flags.overwrite);
    base::OutputPath charts(fs::path(flags.output) / "performance", labelled_scans::kCharts,
                            flags.overwrite);
    const Performance performance = measure(flags);
    fs::create_directory(charts.temporary());
    drawFlights(charts.temporary(), performance.chart);
    std::ofstream out(document.temporary());
    out << documentOf(performance);
    out.close();
    if (!out) {
        throw std::runtime_error(document.path().string() +
                                 ": cannot be written; is the disk full?");
    }
    charts.commit();
    document.commit();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Times whole flights, and writes performance.md."};
    app.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    Flags flags;
    addFlags(app, flags);
    try {
        app.parse(argc, argv);
        run(flags);
        return 0;
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "performance-report: " << e.what() << "\n";
        return 1;
    }
}
