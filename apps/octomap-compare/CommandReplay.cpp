// octomap-compare replay: one run of a folder, flown again to be looked at.
#include <hagen/logs/CloseWritten.h>
#include <hagen/logs/OutputPath.h>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "ChooseRun.h"
#include "Commands.h"
#include "FlownRuns.h"
#include "Replay.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

struct Flags {
    std::string folder, output;
    RunWanted wanted;
    bool overwrite = false;
};

Run chosen(const fs::path& folder, const RunWanted& wanted) {
    const std::vector<Run> runs = readFlownRuns(folder).runs;
    try {
        return chooseRun(runs, wanted);
    } catch (const std::invalid_argument& e) {
        throw CLI::ValidationError(folder.string(), e.what());
    }
}

int run(const Flags& flags) {
    const fs::path folder = flags.folder;
    const fs::path into = flags.output.empty() ? folder : fs::path(flags.output);
    const Run wanted = chosen(folder, flags.wanted);
    const LatencyProfile profile = readLatencyProfile(folder / "profile.json");
    fs::create_directories(into);
    const std::string name = "replay-" + fileNameOf(wanted);
    OutputPath page(into / (name + ".html"), OutputPath::Kind::File, flags.overwrite);
    OutputPath scene(into / (name + ".3Dscene"), OutputPath::Kind::File, flags.overwrite);

    const Recording recording = record(wanted, profile);
    writeText(replayPage(recording), page.temporary(), page.path());
    writeReplayScene(recording, scene.temporary(), scene.path());
    page.commit();
    scene.commit();
    std::cout << choiceOf(wanted, {wanted}) << "\n"
              << recording.ending << "\n"
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
    RunWanted& wanted = flags->wanted;
    CLI::App* sub = app.add_subcommand(
        "replay", "fly one run again: replay-RUN.html, a page, and replay-RUN.3Dscene");
    sub->add_option("DIR", flags->folder, "folder of `closedloop`, finished or not")->required();
    sub->add_option("--seed", wanted.seed, "seed of the run")->required();
    sub->add_option("--scenario", wanted.scenario, "where several have that seed");
    sub->add_option("--model", wanted.model, "where several flew it");
    sub->add_option("--guidance", wanted.guidance, "straight or astar");
    sub->add_option("--speed", wanted.speed_m_s, "m/s");
    sub->add_option("--planner", wanted.planner, "primitives or 3dvfh");
    sub->add_option("--pose-error", wanted.pose_error, "none, noise or drift");
    sub->add_option("--latency-scale", wanted.latency_scale, "of the latency profile");
    sub->add_option("--unknown", wanted.unknown, "space that was never seen, as for `closedloop`")
        ->transform([](const std::string& name) {
            return name == "brake_known" ? "brake-known" : name;  // as runs.csv has it
        })
        ->check(CLI::IsMember({"optimistic", "brake-known"}));
    sub->add_option("-o,--output", flags->output, "folder to write to; without: DIR");
    sub->add_flag("--overwrite", flags->overwrite, "replace the replay of this run");
    sub->callback([flags, &command] { command = [flags] { return run(*flags); }; });
}

}  // namespace hagen
