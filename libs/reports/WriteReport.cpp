#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/Folder.h>
#include <hagen/base/OutputSet.h>
#include <hagen/base/WriteFile.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/ReportSentences.h>
#include <hagen/reports/SummaryFiles.h>
#include <hagen/reports/Verdict.h>
#include <hagen/reports/WriteReport.h>
#include <deque>
#include <stdexcept>

namespace hagen::reports {
namespace {

namespace fs = std::filesystem;

/// Everything except the worst runs.
Report readReport(const ReportRequest& request) {
    const fs::path& folder = request.folder;
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(
            folder.string() +
            ": no such folder; expected one written by octomap-compare closedloop");
    }
    Report report;
    report.flown = trials::readFlownRuns(folder);
    if (report.flown.runs.empty()) {
        throw std::runtime_error(folder.string() +
                                 ": no run is finished yet; run octomap-compare closedloop");
    }
    report.summary = summarize(report.flown.runs);
    if (fs::exists(folder / "profile.json")) {
        report.profile = trials::readLatencyProfile(folder / "profile.json");
    }
    const fs::path memory = request.memory.empty() ? folder / "memory.csv" : request.memory;
    if (!request.memory.empty() || fs::exists(memory))
        report.memory = trials::readHeapCurves(memory);
    return report;
}

/// Finds out what cannot be written before minutes of flying.
void checkOutputs(const ReportRequest& request) {
    const fs::path& folder = request.folder;
    base::checkApart(
        {request.markdown, folder / "report.html", folder / "summary.json", folder / "summary.csv"},
        {request.memory, folder / "runs.csv", folder / "measured.csv", folder / "campaign.json",
         folder / "profile.json", folder / "journal", folder / "memory.csv"});
    const auto check = [&](const fs::path& path) {
        base::OutputPath(path, base::kFile, request.overwrite);
    };
    for (const char* name : {"report.html", "summary.json", "summary.csv"}) {
        check(request.folder / name);
    }
    if (!request.markdown.empty()) check(request.markdown);
}

void addWorst(const ReportRequest& request, Report& report) {
    if (request.worst == 0) return;
    if (!report.profile) {
        report.worst_missing = {"The runs cannot be flown again: the folder has no profile.json."};
        return;
    }
    for (const trials::Run& run : replays::worstRuns(report.flown.runs, request.worst)) {
        const std::string course = run.scenario + ", seed " + std::to_string(run.seed);
        request.continuing();
        request.doing("flying again: " + course + ", " + avoidance::displayName(run.setup.model));
        try {
            report.worst.push_back(
                replays::viewFromAbove(run, *report.profile, request.continuing));
        } catch (const std::exception& e) {
            request.continuing();  // throws if that was the reason
            report.worst_missing.push_back(course + ", " + nameOf(trials::contenderOf(run)) + ", " +
                                           nameOf(trials::conditionOf(run)) +
                                           ", cannot be flown again: " + e.what());
        }
    }
}

void writeOutputs(const ReportRequest& request, const Report& report) {
    std::deque<base::OutputPath> places;
    base::OutputSet outputs;
    const auto write = [&](const fs::path& path, const std::string& text) {
        base::OutputPath& place = places.emplace_back(path, base::kFile, request.overwrite);
        outputs.add(place);
        outputs.write(place, [&] { base::writeText(text, place.temporary(), path); });
    };
    write(request.folder / "report.html", reportPage(report));
    write(request.folder / "summary.json", summaryJson(report.summary, report.flown));
    write(request.folder / "summary.csv", summaryCsv(report.summary));
    if (!request.markdown.empty()) write(request.markdown, reportMarkdown(report));
    outputs.commit();
}

}  // namespace

std::vector<std::string> writeReport(const ReportRequest& request) {
    Report report = readReport(request);
    checkOutputs(request);
    addWorst(request, report);
    request.continuing();
    writeOutputs(request, report);

    std::vector<std::string> lines;
    const std::string unfinished = unfinishedSentence(report.flown);
    if (!unfinished.empty()) lines.push_back(unfinished);
    for (const std::string& sentence : verdictOf(report.summary)) lines.push_back(sentence);
    lines.push_back((request.folder / "report.html").string());
    return lines;
}

}  // namespace hagen::reports
