// octomap-compare openloop: compares world models on a recorded log.
#include <hagen/avoidance/OpenLoop.h>
#include <hagen/settings/Presets.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "Commands.h"
#include "avoidance/openloop/OpenLoopFiles.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/ProgressLine.h"
#include "base/command_line/Terminal.h"

namespace hagen {
namespace {

struct Flags {
    avoidance::OpenLoop open_loop;
    std::vector<std::string> configs, keys;
    std::string folder, scenario;
    std::uint64_t seed = 1;
    bool overwrites = false, is_quiet = false;
};

/// All models except those that predict motion, because open loop queries clearances only at scan
/// times; without a scene, also omits models that need ground truth.
std::vector<std::string> standardModels(bool has_scene) {
    std::vector<std::string> models = avoidance::worldModelNames();
    const auto isMissing = [=](const std::string& model) {
        return avoidance::predictsMotion(model) || (avoidance::needsTruth(model) && !has_scene);
    };
    models.erase(std::remove_if(models.begin(), models.end(), isMissing), models.end());
    return models;
}

void print(std::size_t count, const std::string& one, const std::string& what) {
    if (count == 0) return;
    std::cerr << "octomap-compare: " << count << " " << one << (count == 1 ? " " : "s ")
              << oneLine(what) << "\n";
}

void printLosses(const avoidance::OpenLoopResult& result) {
    print(result.scans_without_pose, "scan", "skipped: no pose within 0.2 s");
    print(result.unreadable_scans, "scan",
          "skipped: unreadable; the first: " + result.why_unreadable);
    for (const std::string& remark : result.remarks) {
        std::cerr << "octomap-compare: " << oneLine(remark) << "\n";
    }
}

void printLimits(const avoidance::OpenLoopResult& result) {
    print(result.scans_placed_by_one_pose, "scan",
          "placed with a single pose, because the returns have no times or the poses do not "
          "cover the whole scan");
    print(result.model_resets, "reset",
          "of all models, because the flight exceeds the size of the maps");
    if (!result.poses_have_horizon) {
        std::cerr << "octomap-compare: poses and level directions are relative to the first "
                     "scan\n";
    }
}

int run(Flags flags) {
    avoidance::OpenLoop& open_loop = flags.open_loop;
    if (!flags.scenario.empty()) open_loop.scene = {flags.scenario, flags.seed};
    if (open_loop.models.empty()) open_loop.models = standardModels(open_loop.scene.has_value());
    avoidance::checkOpenLoop(open_loop);
    for (const std::string& config : flags.configs) {
        mergeSettings(presetFile(config), open_loop.source.settings);
    }
    for (const std::string& key : flags.keys) mergeKey(key, open_loop.source.settings);
    std::vector<std::filesystem::path> inputs = open_loop.source.settings.files;
    inputs.insert(inputs.end(),
                  {open_loop.source.log, open_loop.source.poses, open_loop.source.sensor_json});
    avoidance::OpenLoopFiles files(flags.folder, flags.overwrites, inputs);
    ProgressLine progress("scan");
    avoidance::OpenLoopListener listener;
    listener.row = [&](const avoidance::OpenLoopRow& row, const avoidance::OpenLoopCost& cost) {
        files.add(row, cost);
    };
    listener.keep_going = [] { return !isInterrupted(); };
    if (!flags.is_quiet) {
        listener.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
    }
    const auto show = [&](const avoidance::OpenLoopResult& result) {
        printLosses(result);
        if (flags.is_quiet) return;
        printLimits(result);
        std::cout << avoidance::tableOf(open_loop, result) << std::flush;
    };
    try {
        const avoidance::OpenLoopResult result = avoidance::runOpenLoop(open_loop, listener);
        show(result);  // shown first, because writing files may fail
        files.commit(open_loop, result);
        return 0;
    } catch (const avoidance::OpenLoopEnded& ended) {
        show(ended.result);
        const std::string failures = files.keepPartial(open_loop, ended.result);
        throw std::runtime_error(std::string(ended.what()) + "; results of the " +
                                 std::to_string(ended.result.scans) + " preceding scans are in " +
                                 flags.folder + "/*.partial*" +
                                 (failures.empty() ? "" : "; " + failures));
    }
}

/// Runs the command; reports invalid settings and names as wrong usage.
int runChecked(const Flags& flags) {
    try {
        return run(flags);
    } catch (const SettingsError& e) {
        throw UsageError("--config", e.what());
    } catch (const std::invalid_argument& e) {
        throw UsageError("openloop", e.what());
    }
}

}  // namespace

void addOpenLoop(Program& program) {
    const auto flags = std::make_shared<Flags>();
    avoidance::LogSource& source = flags->open_loop.source;
    Command sub = program.subcommand(
        "openloop", "compare world models on a recorded log: cost and correctness");
    sub.option("-i,--input", source.log,
               "rawlog, capture (.pcap), ROS recording (.bag, .mcap, .db3) or scan folder (KITTI "
               "layout)")
        .existingPath()
        .required();
    sub.option("--sensor-json", source.sensor_json, "Ouster metadata file (JSON)").existingFile();
    sub.option("--topic", source.topics, "read only this LiDAR topic of a ROS recording").once();
    sub.option("--poses", source.poses,
               "vehicle poses (TUM) or sensor poses, one per scan (KITTI); overrides the "
               "poses in the log")
        .existingFile();
    sub.option("--sensor-label", source.sensor_label, "use only this LiDAR");
    sub.option("--own-reach-m", source.own_reach_m,
               "skip returns nearer than this [m] as the vehicle's own")
        .between(0.0, 5.0)
        .showDefault();
    takesWorldModels(sub.option("--models", flags->open_loop.models,
                                "world models, such as W-RoI or \"RoI window\" (default: all)")
                         .delimiter(','));
    const Flag scenario = sub.option("--truth-scenario", flags->scenario,
                                     "rawlog-simulate scenario of the log, used as "
                                     "ground truth (default: raw points of later scans)");
    sub.option("--truth-seed", flags->seed, "seed of that scenario").needs(scenario).showDefault();
    sub.option("-c,--config", flags->configs,
               "settings file, or the name of a preset such as hdl32e; repeatable, later ones "
               "override earlier ones")
        .once();
    sub.option("--set", flags->keys, "KEY=VALUE: one key of the settings; repeatable").once();
    sub.option("-o,--output", flags->folder, "folder for tables and summary.json").required();
    sub.flag("--overwrite", flags->overwrites, "replace existing tables");
    sub.flag("-q,--quiet", flags->is_quiet, "print errors only");
    sub.does([flags] { return runChecked(*flags); });
}

}  // namespace hagen
