// octomap-compare calibrate: measures what each stage takes on this machine.
#include <hagen/avoidance/WorldModel.h>
#include <hagen/logs/CloseWritten.h>
#include <hagen/logs/OutputPath.h>
#include <hagen/trials/Calibration.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

#include "Commands.h"
#include "common/Interrupt.h"

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
                  << "); latencies measured now may be too long\n";
    }
}

void printProfile(const LatencyProfile& profile) {
    std::cout << "stage                          p50 ms    p95 ms    max ms\n" << std::fixed;
    for (const auto& [stage, quantiles] : profile.quantiles_ms) {
        std::cout << std::left << std::setw(27) << stage << std::right << std::setprecision(3);
        for (const double share : {0.5, 0.95, 1.0}) {
            std::cout << std::setw(10) << profile.at_ms(stage, share);
        }
        std::cout << "\n";
    }
}

void writeMemory(const Flags& flags, const std::vector<std::string>& models,
                 const std::filesystem::path& file) {
    std::ofstream out = openToWrite(file, flags.memory);
    out << "model,path_m,bytes\n";
    for (const std::string& model : models) {
        if (isInterrupted()) {
            throw std::runtime_error("interrupted; " + flags.memory + " was not written");
        }
        std::cerr << "memory of " << model << "\n";
        for (const HeapSample& sample : heapAlongFlight(model, flags.path_m)) {
            out << model << "," << std::round(10 * sample.path_m) / 10 << ","
                << static_cast<long long>(sample.bytes) << "\n";
        }
    }
    closeWritten(out, flags.memory);
}

int run(const Flags& flags) {
    std::vector<std::string> models = flags.models;
    if (models == std::vector<std::string>{"all"}) models = worldModelNames();
    std::optional<OutputPath> profile_file, memory_file;
    if (!flags.file.empty()) {
        profile_file.emplace(flags.file, OutputPath::Kind::File, flags.overwrites);
    }
    if (!flags.memory.empty()) {
        memory_file.emplace(flags.memory, OutputPath::Kind::File, flags.overwrites);
    }
    warnIfBusy();
    if (profile_file) {
        CalibrationOptions options;
        options.models = models;
        options.courses = flags.is_quick ? 1 : 3;
        options.doing = [](const std::string& model) {
            if (isInterrupted()) throw std::runtime_error("interrupted; nothing was written");
            std::cerr << "latencies of " << model << "\n";
        };
        const LatencyProfile profile = calibrate(options);
        writeLatencyProfile(profile, profile_file->temporary());
        profile_file->commit();
        printProfile(profile);
    }
    if (memory_file) {
        writeMemory(flags, models, memory_file->temporary());
        memory_file->commit();
    }
    return 0;
}

}  // namespace

void addCalibrate(CLI::App& app, Command& command) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* sub = app.add_subcommand(
        "calibrate", "measure what each stage takes on this machine; let nothing else run");
    const auto file = sub->add_option("-o,--output", flags->file, "latency profile (JSON)");
    const auto memory = sub->add_option("--memory", flags->memory,
                                        "CSV of the heap that each model holds along a flight");
    sub->add_option("--models", flags->models, "world models, or all")
        ->delimiter(',')
        ->check(CLI::IsMember([] {
            std::vector<std::string> names = worldModelNames();
            names.emplace_back("all");
            return names;
        }()));
    sub->add_option("--path-m", flags->path_m, "length of that flight")
        ->check(CLI::Range(10.0, 10000.0))
        ->capture_default_str();
    sub->add_flag("--quick", flags->is_quick, "one course instead of three");
    sub->add_flag("--overwrite", flags->overwrites, "replace files that exist");
    sub->callback([flags, file, memory, &command] {
        if (file->count() + memory->count() == 0) {
            throw CLI::RequiredError("an output (-o or --memory)");
        }
        command = [flags] { return run(*flags); };
    });
}

}  // namespace hagen
