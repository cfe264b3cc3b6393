// octomap-compare report: what the runs of a folder tell.
#include <hagen/reports/WriteReport.h>
#include <iostream>
#include <memory>

#include "Commands.h"

namespace hagen {
namespace {

int run(reports::ReportRequest request) {
    request.doing = [](const std::string& what) { std::cerr << what << "\n"; };
    for (const std::string& line : reports::writeReport(request)) std::cout << line << "\n";
    return 0;
}

}  // namespace

void addReport(Program& program) {
    const auto flags = std::make_shared<reports::ReportRequest>();
    Command sub = program.subcommand(
        "report", "what runs tell: report.html, summary.json and summary.csv in their folder");
    sub.option("DIR", flags->folder, "folder of `closedloop`, finished or not").required();
    sub.option("--memory", flags->memory,
               "CSV of `calibrate --memory`; without: DIR/memory.csv, where there is one");
    sub.option("--markdown", flags->markdown, "file for the main tables as Markdown");
    sub.option("--worst", flags->worst, "worst runs to fly again for a look from above")
        .showDefault()
        .between(0, 100);
    sub.flag("--overwrite", flags->overwrite, "replace outputs that exist");
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
