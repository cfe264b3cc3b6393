// octomap-compare openloop: world models digest a recorded log.
#include <hagen/openloop/OpenLoop.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <hagen/command_line/Interrupt.h>
#include <hagen/command_line/ProgressLine.h>
#include <hagen/openloop/OpenLoopFiles.h>
#include <hagen/openloop/OpenLoopTable.h>
#include "Commands.h"

namespace hagen {
namespace {

struct Flags {
    openloop::OpenLoop open_loop;
    std::vector<std::string> configs;
    std::string folder, scenario;
    std::uint64_t seed = 1;
    bool overwrites = false, is_quiet = false;
};

/// All; the oracle where there is a scene that it can know.
std::vector<std::string> standardModels(bool has_scene) {
    std::vector<std::string> models = avoidance::worldModelNames();
    if (!has_scene) models.erase(std::find(models.begin(), models.end(), "oracle"));
    return models;
}

/// What a user should know about the figures.
void tellRemarks(const openloop::OpenLoopResult& result) {
    const auto tell = [](std::size_t scans, const std::string& what) {
        if (scans > 0) std::cerr << "octomap-compare: " << scans << " " << what << "\n";
    };
    tell(result.scans_without_pose, "scans have no pose within 0.2 s, and were left out");
    tell(result.unreadable_scans, "scans could not be read, and were left out");
    tell(
        result.scans_moved_whole,
        "scans were placed by one pose each: their returns have no times, or poses do not reach to "
        "their ends");
    tell(result.maps_begun_anew,
         "times all models were begun anew: the flight is longer than a box of maps");
    if (!result.poses_have_horizon) {
        std::cerr << "octomap-compare: the poses are seen from the first scan, and so are level "
                     "directions\n";
    }
}

int run(Flags flags) {
    openloop::OpenLoop& open_loop = flags.open_loop;
    if (!flags.scenario.empty()) open_loop.scene = {flags.scenario, flags.seed};
    if (open_loop.models.empty()) open_loop.models = standardModels(open_loop.scene.has_value());
    openloop::checkOpenLoop(open_loop);
    for (const std::string& config : flags.configs) {
        observations::mergeSettings(config, open_loop.source.settings);
    }
    openloop::OpenLoopFiles files(flags.folder, flags.overwrites);
    ProgressLine progress("scan");
    openloop::OpenLoopListener listener;
    listener.row = [&](const openloop::OpenLoopRow& row, const openloop::OpenLoopCost& cost) {
        files.add(row, cost);
    };
    listener.keep_going = [] { return !isInterrupted(); };
    if (!flags.is_quiet) {
        listener.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
    }
    try {
        const openloop::OpenLoopResult result = openloop::runOpenLoop(open_loop, listener);
        files.commit(open_loop, result);
        if (flags.is_quiet) return 0;
        tellRemarks(result);
        std::cout << openloop::tableOf(open_loop, result);
        return 0;
    } catch (const openloop::OpenLoopEnded& ended) {
        files.keepPartial(open_loop, ended.result);
        if (!flags.is_quiet) {
            tellRemarks(ended.result);
            std::cout << openloop::tableOf(open_loop, ended.result);
        }
        throw std::runtime_error(std::string(ended.what()) + "; figures of the " +
                                 std::to_string(ended.result.scans) + " scans before it are in " +
                                 flags.folder + "/*.partial*");
    }
}

/// Wrong usage is told as such.
int runChecked(const Flags& flags) {
    try {
        return run(flags);
    } catch (const observations::SettingsError& e) {
        throw UsageError("--config", e.what());
    } catch (const std::invalid_argument& e) {
        throw UsageError("openloop", e.what());
    }
}

}  // namespace

void addOpenLoop(Program& program) {
    const auto flags = std::make_shared<Flags>();
    openloop::LogSource& source = flags->open_loop.source;
    Command sub = program.subcommand(
        "openloop", "let all world models digest a recorded log: what they cost, what they know");
    sub.option("-i,--input", source.log, "a .rawlog, or a scan folder (KITTI layout)")
        .existingPath()
        .required();
    sub.option("--poses", source.poses,
               "where the vehicle was (TUM), or the sensor scan by scan (KITTI); wins over "
               "the log's own")
        .existingFile();
    sub.option("--sensor-label", source.sensor_label, "this LiDAR alone");
    sub.option("--own-reach-m", source.own_reach_m,
               "returns nearer to the sensor are the vehicle's own")
        .between(0.0, 5.0)
        .showDefault();
    sub.option("--models", flags->open_loop.models, "world models (default: all)").delimiter(',');
    const Flag scenario = sub.option("--truth-scenario", flags->scenario,
                                     "scene that rawlog-simulate made the log in: the truth "
                                     "(default: the raw points of later scans)");
    sub.option("--truth-seed", flags->seed, "its seed").needs(scenario).showDefault();
    sub.option("-c,--config", flags->configs, "settings file; may be repeated, later ones win")
        .once();
    sub.option("-o,--output", flags->folder, "folder for tables and summary.json").required();
    sub.flag("--overwrite", flags->overwrites, "replace tables that exist");
    sub.flag("-q,--quiet", flags->is_quiet, "print errors only");
    sub.does([flags] { return runChecked(*flags); });
}

}  // namespace hagen
