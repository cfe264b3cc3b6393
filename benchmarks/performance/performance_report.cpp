// Times entire flights, and writes docs/performance.md from these times and the output of
// stage-benchmarks and conversion-benchmark. Run by scripts/measure-performance.
#include <hagen/base/OutputPath.h>
#include <fstream>
#include <iostream>
#include "evaluation/labelled_folders/Charts.h"

#include "Document.h"
#include "base/command_line/CommandLine.h"

namespace {

using namespace hagen;
using namespace hagen::base;
namespace fs = std::filesystem;

struct Flags {
    std::string output, stages, conversion, revision = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(Command& app, Flags& flags) {
    app.option("-o,--output", flags.output, "folder for performance.md and performance/")
        .required()
        .existingFolder();
    app.option("--stages", flags.stages, "output of stage-benchmarks --json")
        .required()
        .existingFile();
    app.option("--conversion", flags.conversion, "output of conversion-benchmark --json")
        .existingFile();
    app.option("--revision", flags.revision, "revision of the project, for the document");
    app.flag("--quick", flags.is_quick, "few scans, for testing");
    app.flag("--overwrite", flags.overwrite, "replace existing results");
}

Performance measure(const Flags& flags) {
    Performance p;
    p.revision = flags.revision;
    p.is_quick = flags.is_quick;
    p.rows = readTimedRows(flags.stages);
    if (!flags.conversion.empty()) p.conversions = readConversionTimes(flags.conversion);
    const int scale = flags.is_quick ? 50 : 1;
    p.table = timeFlight("orchard", 1, 1500 / scale);
    std::cerr << "timed: orchard\n";
    for (const char* scenario : {"street", "forest-0.05", "field"}) {
        p.chart.push_back(timeFlight(scenario, 1, 1000 / scale));
        std::cerr << "timed: " << scenario << "\n";
    }
    return p;
}

int run(const Flags& flags) {
    base::OutputPath document(fs::path(flags.output) / "performance.md", base::kFile,
                              flags.overwrite);
    base::OutputPath charts(fs::path(flags.output) / "performance", evaluation::kCharts,
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
    return kDone;
}

}  // namespace

int main(int argc, char** argv) {
    Program program("performance-report", "Times entire flights and writes performance.md.");
    program.footer("Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    Flags flags;
    addFlags(program, flags);
    return program.run(argc, argv, [&] { return run(flags); });
}
