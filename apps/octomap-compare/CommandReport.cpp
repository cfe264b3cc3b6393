// octomap-compare report: what the runs of a folder tell.
#include <hagen/logs/CloseWritten.h>
#include <hagen/logs/OutputPath.h>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "Commands.h"
#include "Report.h"
#include "ReportWords.h"
#include "SummaryFiles.h"
#include "Verdict.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

struct Flags {
    std::string folder, memory, markdown;
    int worst = 6;
    bool overwrite = false;
};

/// A text file that is to appear with others.
struct TextOutput {
    TextOutput(const fs::path& path, bool overwrite, std::string content)
        : place(path, OutputPath::Kind::File, overwrite), text(std::move(content)) {
        writeText(text, place.temporary(), path);
    }
    OutputPath place;
    std::string text;
};

/// memory.csv: model,path_m,bytes; a row a place along a flight.
std::vector<MemoryCurve> readMemory(const fs::path& file) {
    std::vector<MemoryCurve> curves;
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        if (line == 1) continue;
        const std::size_t first = text.find(','), second = text.find(',', first + 1);
        try {
            if (second == std::string::npos) throw std::invalid_argument(text);
            const std::string model = text.substr(0, first);
            const double path_m = std::stod(text.substr(first + 1));
            const double bytes = std::stod(text.substr(second + 1));
            if (curves.empty() || curves.back().model != model) curves.push_back({model, {}});
            curves.back().bytes_by_path_m.emplace_back(path_m, bytes);
        } catch (const std::logic_error&) {
            throw std::runtime_error(file.string() + ":" + std::to_string(line) +
                                     ": not model,path_m,bytes: " + text);
        }
    }
    return curves;
}

void addWorst(std::size_t count, Report& report) {
    if (count == 0 || report.flown.runs.empty()) return;
    if (!report.profile) {
        report.worst_missing = {"They cannot be flown again: the folder has no profile.json."};
        return;
    }
    for (const Run& run : worstRuns(report.flown.runs, count)) {
        std::cerr << "flying again: " << run.scenario << ", seed " << run.seed << ", "
                  << run.setup.model << "\n";
        try {
            report.worst.push_back(viewFromAbove(run, *report.profile));
        } catch (const std::exception& e) {
            report.worst_missing.push_back(run.scenario + ", seed " + std::to_string(run.seed) +
                                           ", " + nameOf(contenderOf(run)) + ", " +
                                           nameOf(conditionOf(run)) +
                                           ", cannot be flown again: " + e.what());
        }
    }
}

int run(const Flags& flags) {
    const fs::path folder = flags.folder;
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() +
                                 ": no such folder; give one of octomap-compare closedloop");
    }
    Report report;
    report.flown = readFlownRuns(folder);
    if (report.flown.runs.empty()) {
        throw std::runtime_error(folder.string() +
                                 ": no run is finished yet; fly some with octomap-compare "
                                 "closedloop");
    }
    report.summary = summarize(report.flown.runs);
    if (fs::exists(folder / "profile.json")) {
        report.profile = readLatencyProfile(folder / "profile.json");
    }
    const fs::path memory = flags.memory.empty() ? folder / "memory.csv" : fs::path(flags.memory);
    if (!flags.memory.empty() || fs::exists(memory)) report.memory = readMemory(memory);
    // Places first: what cannot be written shall be told before minutes of flying.
    const auto check = [&](const fs::path& path) {
        OutputPath(path, OutputPath::Kind::File, flags.overwrite);
    };
    for (const char* name : {"report.html", "summary.json", "summary.csv"}) check(folder / name);
    if (!flags.markdown.empty()) check(flags.markdown);
    addWorst(static_cast<std::size_t>(flags.worst), report);

    std::vector<std::unique_ptr<TextOutput>> outputs;
    const auto write = [&](const fs::path& path, std::string text) {
        outputs.push_back(std::make_unique<TextOutput>(path, flags.overwrite, std::move(text)));
    };
    write(folder / "report.html", reportPage(report));
    nlohmann::ordered_json summary = jsonOf(report.summary);
    if (report.flown.planned > 0) {
        summary["planned_runs"] = report.flown.planned;
        summary["missing_runs"] = report.flown.missing;
    }
    write(folder / "summary.json", summary.dump(2) + "\n");
    write(folder / "summary.csv", csvOf(report.summary));
    if (!flags.markdown.empty()) write(flags.markdown, reportMarkdown(report));
    for (const auto& output : outputs) output->place.commit();
    const std::string unfinished = unfinishedWords(report.flown);
    if (!unfinished.empty()) std::cout << unfinished << "\n";
    for (const std::string& words : verdictOf(report.summary)) std::cout << words << "\n";
    std::cout << (folder / "report.html").string() << "\n";
    return 0;
}

}  // namespace

void addReport(CLI::App& app, Command& command) {
    const auto flags = std::make_shared<Flags>();
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
