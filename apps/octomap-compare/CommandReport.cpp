// octomap-compare report: reports on the runs of a folder.
#include <hagen/command_line/Interrupt.h>
#include <hagen/reports/WriteReport.h>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "Commands.h"

namespace hagen {
namespace {

int run(reports::ReportRequest request) {
    request.doing = [](const std::string& what) { std::cerr << what << "\n"; };
    request.continuing = [] {
        if (isInterrupted()) throw std::runtime_error("interrupted; nothing was written");
    };
    for (const std::string& line : reports::writeReport(request)) std::cout << line << "\n";
    tellLeftBehind({request.folder / "report.html", request.folder / "summary.json",
                    request.folder / "summary.csv", request.markdown});
    return 0;
}

}  // namespace

void addReport(Program& program) {
    const auto flags = std::make_shared<reports::ReportRequest>();
    Command sub = program.subcommand(
        "report", "write report.html, summary.json and summary.csv of a campaign into its folder");
    sub.option("DIR", flags->folder, "folder of `closedloop`, finished or not").required();
    sub.option("--memory", flags->memory,
               "CSV file of `calibrate --memory` (default: DIR/memory.csv, if it exists)");
    sub.option("--markdown", flags->markdown, "Markdown file for the main tables");
    sub.option("--worst", flags->worst, "number of worst runs to fly again for views from above")
        .showDefault()
        .between(0, 100);
    sub.flag("--overwrite", flags->overwrite, "replace existing outputs");
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
