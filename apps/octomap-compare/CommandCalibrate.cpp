// octomap-compare calibrate: measures the latency of each stage on this machine.
#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/OutputPath.h>
#include "avoidance/flights/Calibration.h"
#include "base/OutputSet.h"
#include "base/WriteFile.h"

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

#include "Commands.h"
#include "base/command_line/Interrupt.h"

namespace hagen {
namespace {

struct Flags {
    std::string file, memory;
    std::vector<std::string> models{"all"};
    double path_m = 1000;
    bool is_quick = false, overwrites = false;
};

void warnIfBusy() {
    double load = 0;
    if (getloadavg(&load, 1) == 1 && load > 0.5) {
        std::cerr << "octomap-compare: this machine is busy (load " << load
                  << "); measured latencies may be too high\n";
    }
}

void printProfile(const avoidance::LatencyProfile& profile) {
    std::cout << "stage                          p50 ms    p95 ms    max ms\n" << std::fixed;
    for (const auto& [stage, quantiles] : profile.quantiles_ms) {
        std::cout << std::left << std::setw(27) << stage << std::right << std::setprecision(3);
        for (const double share : {0.5, 0.95, 1.0}) {
            std::cout << std::setw(10) << profile.at_ms(stage, share);
        }
        std::cout << "\n";
    }
}

int run(const Flags& flags, bool has_output) {
    if (!has_output) throw UsageError("an output is required (-o or --memory)");
    const std::vector<std::string> models =
        namesFrom("--models", flags.models, avoidance::worldModelNames());
    base::checkApart({flags.file, flags.memory}, {});
    std::optional<base::OutputPath> profile_file, memory_file;
    if (!flags.file.empty()) {
        profile_file.emplace(flags.file, base::kFile, flags.overwrites);
    }
    if (!flags.memory.empty()) {
        memory_file.emplace(flags.memory, base::kFile, flags.overwrites);
    }
    base::OutputSet outputs;  // renamed into place when complete
    if (profile_file) outputs.add(*profile_file);
    if (memory_file) outputs.add(*memory_file);
    warnIfBusy();
    if (profile_file) {
        avoidance::CalibrationOptions options;
        options.models = models;
        options.courses = flags.is_quick ? 1 : 4;
        options.doing = [](const std::string& model) {
            std::cerr << "measuring latencies: " << avoidance::displayName(model) << "\n";
        };
        options.continuing = [] {
            if (isInterrupted()) throw std::runtime_error("interrupted; no output was written");
        };
        const avoidance::LatencyProfile profile = avoidance::calibrate(options);
        printProfile(profile);
        outputs.write(*profile_file, [&] {
            base::writeText(textOf(profile), profile_file->temporary(), profile_file->path());
            profile_file->commit();
        });
    }
    if (memory_file) {
        const auto begin = [](const std::string& model) {
            std::cerr << "measuring memory: " << avoidance::displayName(model) << "\n";
        };
        const auto continuing = [&] {
            if (isInterrupted()) {
                throw std::runtime_error("interrupted; " + flags.memory + " was not written");
            }
        };
        outputs.write(*memory_file, [&] {
            avoidance::writeCostCurves(models, flags.path_m, begin, continuing,
                                       memory_file->temporary(), flags.memory);
            memory_file->commit();
        });
    }
    if (!outputs.failures().empty()) throw std::runtime_error(outputs.failures());
    return 0;
}

}  // namespace

void addCalibrate(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub = program.subcommand(
        "calibrate", "measure the latency of each stage on this machine, which should be idle");
    const Flag file = sub.option("-o,--output", flags->file, "latency profile (JSON)");
    const Flag memory = sub.option("--memory", flags->memory,
                                   "CSV file: memory and update time of each model along a flight");
    takesWorldModels(
        sub.option("--models", flags->models, "world models (default: all)").delimiter(','),
        {"all"});
    sub.option("--path-m", flags->path_m, "length of the flight for --memory [m]")
        .between(10.0, 10000.0)
        .needs(memory)
        .showDefault();
    sub.flag("--quick", flags->is_quick, "one course instead of four").needs(file);
    sub.flag("--overwrite", flags->overwrites, "replace existing files");
    sub.does([flags, file, memory] { return run(*flags, file.isGiven() || memory.isGiven()); });
}

}  // namespace hagen
