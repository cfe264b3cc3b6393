// octomap-compare replay: one run of a folder, flown again to be looked at.
#include <hagen/logs/OutputPath.h>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "Commands.h"
#include "FlownRuns.h"
#include "Replay.h"
#include "Summary.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

struct Flags {
    std::string folder, output;
    std::uint64_t seed = 0;
    std::string scenario, model, guidance, planner, pose_error, unknown;
    double speed_m_s = 0, latency_scale = 0;  ///< 0: any
    bool overwrite = false;
};

bool matches(const Run& run, const Flags& flags) {
    const auto is = [](const std::string& wanted, const std::string& value) {
        return wanted.empty() || wanted == value;
    };
    const TrialSetup& setup = run.setup;
    return run.seed == flags.seed && is(flags.scenario, run.scenario) &&
           is(flags.model, setup.model) && is(flags.guidance, setup.guidance) &&
           is(flags.planner, setup.planner) && is(flags.pose_error, nameOf(setup.pose_error)) &&
           is(flags.unknown, setup.brakes_in_known_space ? "brake_known" : "optimistic") &&
           (flags.speed_m_s == 0 || flags.speed_m_s == setup.speed_m_s) &&
           (flags.latency_scale == 0 || flags.latency_scale == setup.latency_scale);
}

std::string choiceOf(const Run& run) {
    return "--scenario " + run.scenario + " --model " + run.setup.model + " --guidance " +
           run.setup.guidance + "   (" + nameOf(conditionOf(run)) + ": " +
           nameOf(run.result.outcome) + ")";
}

/// The only run that the flags name. Throws CLI::ValidationError where there is none, or several.
Run chosen(const std::vector<Run>& runs, const Flags& flags, const fs::path& table) {
    std::vector<Run> found;
    for (const Run& run : runs) {
        if (matches(run, flags)) found.push_back(run);
    }
    if (found.size() == 1) return found[0];
    if (found.empty()) {
        throw CLI::ValidationError(table.string(),
                                   "has no run of seed " + std::to_string(flags.seed) +
                                       " with these flags; its column seed tells which there are");
    }
    std::string message = std::to_string(found.size()) + " runs of seed " +
                          std::to_string(flags.seed) + " fit; choose one by flags:";
    constexpr std::size_t kMost = 40;
    for (std::size_t i = 0; i < std::min(kMost, found.size()); ++i) {
        message += "\n  " + choiceOf(found[i]);
    }
    if (found.size() > kMost) message += "\n  ...";
    throw CLI::ValidationError(table.string(), message);
}

int run(const Flags& flags) {
    const fs::path folder = flags.folder;
    const fs::path into = flags.output.empty() ? folder : fs::path(flags.output);
    const Run wanted = chosen(readFlownRuns(folder).runs, flags, folder / "runs.csv");
    const LatencyProfile profile = readLatencyProfile(folder / "profile.json");
    fs::create_directories(into);
    OutputPath page(into / "replay.html", OutputPath::Kind::File, flags.overwrite);
    OutputPath scene(into / "replay.3Dscene", OutputPath::Kind::File, flags.overwrite);

    const Recording recording = record(wanted, profile);
    std::ofstream out(page.temporary(), std::ios::binary);
    out << replayPage(recording);
    out.close();
    if (!out) {
        throw std::runtime_error(page.path().string() + ": cannot be written; is the disk full?");
    }
    writeReplayScene(recording, scene.temporary());
    page.commit();
    scene.commit();
    std::cout << choiceOf(wanted) << "\n"
              << page.path().string() << "\n"
              << scene.path().string() << "\n";
    if (recording.is_same) return 0;
    std::cerr << "octomap-compare: flown again it came out otherwise than the table tells; "
                 "was it flown by another version (here "
              << HAGEN_VERSION << ", there " << wanted.version << ") or on another machine?\n";
    return 1;
}

}  // namespace

void addReplay(CLI::App& app, Command& command) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* sub =
        app.add_subcommand("replay", "fly one run again: replay.html and replay.3Dscene");
    sub->add_option("DIR", flags->folder, "folder of `closedloop`, with its runs.csv")->required();
    sub->add_option("--seed", flags->seed, "seed of the run")->required();
    sub->add_option("--scenario", flags->scenario, "where several have that seed");
    sub->add_option("--model", flags->model, "where several flew it");
    sub->add_option("--guidance", flags->guidance, "straight or astar");
    sub->add_option("--speed", flags->speed_m_s, "m/s");
    sub->add_option("--planner", flags->planner, "primitives or 3dvfh");
    sub->add_option("--pose-error", flags->pose_error, "none, noise or drift");
    sub->add_option("--latency-scale", flags->latency_scale, "of the latency profile");
    sub->add_option("--unknown", flags->unknown, "optimistic or brake_known");
    sub->add_option("-o,--output", flags->output, "folder to write to; without: DIR");
    sub->add_flag("--overwrite", flags->overwrite, "replace outputs that exist");
    sub->callback([flags, &command] { command = [flags] { return run(*flags); }; });
}

}  // namespace hagen
