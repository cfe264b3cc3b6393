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

void addReport(CLI::App& app, Command& command) {
    const auto flags = std::make_shared<reports::ReportRequest>();
    CLI::App* sub = app.add_subcommand(
        "report", "what runs tell: report.html, summary.json and summary.csv in their folder");
    sub->add_option("DIR", flags->folder, "folder of `closedloop`, finished or not")->required();
    sub->add_option("--memory", flags->memory,
                    "CSV of `calibrate --memory`; without: DIR/memory.csv, where there is one");
    sub->add_option("--markdown", flags->markdown, "file for the main tables as Markdown");
    sub->add_option("--worst", flags->worst, "worst runs to fly again for a look from above")
        ->capture_default_str()
        ->check(CLI::Range(0, 100));
    sub->add_flag("--overwrite", flags->overwrite, "replace outputs that exist");
    sub->callback([flags, &command] { command = [flags] { return run(*flags); }; });
}

}  // namespace hagen
