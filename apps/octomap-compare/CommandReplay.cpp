// octomap-compare replay: repeats a run and shows it in 3D.
#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/OutputPath.h>
#include <iostream>
#include <memory>
#include <stdexcept>
#include "base/WriteFile.h"
#include "base/command_line/Interrupt.h"

#include <hagen/avoidance/LatencyProfile.h>
#include "Commands.h"
#include "avoidance/flights/RunTable.h"
#include "avoidance/replays/ChooseRun.h"
#include "avoidance/replays/Replay.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;

struct Flags {
    std::string folder, output;
    avoidance::RunWanted wanted;
    bool overwrite = false;
};

avoidance::Run chosen(const fs::path& folder, const avoidance::RunWanted& wanted) {
    const std::vector<avoidance::Run> runs = avoidance::readRuns(folder / "runs.csv");
    try {
        return avoidance::chooseRun(runs, wanted);
    } catch (const std::invalid_argument& e) {
        throw UsageError(folder.string(), e.what());
    }
}

void endIfInterrupted() {
    if (isInterrupted()) throw std::runtime_error("interrupted; no output was written");
}

int run(const Flags& flags) {
    const fs::path folder = flags.folder;
    const fs::path into = flags.output.empty() ? folder : fs::path(flags.output);
    const avoidance::Run wanted = chosen(folder, flags.wanted);
    const avoidance::LatencyProfile profile =
        avoidance::readLatencyProfile(folder / "profile.json");
    fs::create_directories(into);
    const std::string name = "replay-" + avoidance::fileNameOf(wanted);
    base::OutputPath page(into / (name + ".html"), base::kFile, flags.overwrite);

    endIfInterrupted();
    const avoidance::FlightRecording recording =
        avoidance::record(wanted, profile, {}, endIfInterrupted);
    endIfInterrupted();
    base::writeText(avoidance::replayPage(recording), page.temporary(), page.path());
    endIfInterrupted();
    page.commit();
    std::cout << avoidance::choiceOf(wanted, {wanted}) << "\n"
              << recording.ending << "\n"
              << page.path().string() << "\n";
    if (recording.is_same) return 0;
    std::cerr << "octomap-compare: the result differs from the table (program version "
              << HAGEN_VERSION << ", table version " << wanted.version << ")\n";
    return 1;
}

}  // namespace

void addReplay(Program& program) {
    const auto flags = std::make_shared<Flags>();
    avoidance::RunWanted& wanted = flags->wanted;
    Command sub = program.subcommand("replay", "repeat one run; writes replay-RUN.html");
    sub.option("DIR", flags->folder, "folder of `closedloop`").required();
    sub.option("--seed", wanted.seed, "seed of the run").required();
    sub.option("--scenario", wanted.scenario, "required if several runs have that seed");
    sub.option("--model", wanted.model, "world model; required if several flew the course")
        .transform(avoidance::worldModelFrom);
    sub.option("--guidance", wanted.guidance, "straight or astar");
    sub.option("--speed", wanted.speed_m_s, "m/s");
    sub.option("--planner", wanted.planner, "primitives or 3dvfh");
    sub.option("--pose-error", wanted.pose_error, "none, noise or drift");
    sub.option("--latency-scale", wanted.latency_scale, "latency scale factor");
    sub.option("--unknown", wanted.unknown, "unobserved space, see `closedloop`")
        .transform([](const std::string& name) {
            return name == "brake_known" ? "brake-known" : name;  // the name in runs.csv
        })
        .oneOf({"optimistic", "brake-known"});
    sub.option("--air", wanted.air, "dusty or clear").oneOf({"dusty", "clear"});
    sub.option("--distance", wanted.distance, "unbiased or as-stored")
        .oneOf({"unbiased", "as-stored"});
    sub.option("--updates", wanted.updates, "scans or sectors").oneOf({"scans", "sectors"});
    sub.option("-o,--output", flags->output, "output folder (default: DIR)");
    sub.flag("--overwrite", flags->overwrite, "replace the replay of this run");
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
