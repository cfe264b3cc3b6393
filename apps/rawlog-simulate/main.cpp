// Simulates a flight with a LiDAR over a scene, and writes what it measures with the truth.
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>

#include <hagen/simulated_logs/SimulatedLog.h>
#include "common/Interrupt.h"

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;

void declare(CLI::App& app, simulated_logs::SimulatedLog& log, bool& is_quiet) {
    const CLI::Validator not_empty(
        [](const std::string& name) { return name.empty() ? "the name is empty" : ""; }, "PATH");
    const CLI::Validator known_scenario(
        [](const std::string& name) {
            std::string known;
            for (const std::string& scenario : simulation::scenarioNames()) {
                if (scenario == name) return std::string();
                known += (known.empty() ? "" : ", ") + scenario;
            }
            return "unknown scenario '" + name + "'; known are " + known;
        },
        "NAME");

    app.add_option("--scenario", log.scenario, "the scene; an unknown name lists them all")
        ->required()
        ->check(known_scenario)
        ->group("Flight");
    app.add_option("--scans", log.scans, "how many scans")
        ->required()
        ->check(CLI::Range(1, 100000))
        ->group("Flight");
    app.add_option("--altitude", log.altitude_m, "metres above the ground")
        ->required()
        ->check(CLI::Range(1.0, 15.0))
        ->group("Flight");
    app.add_option("--seed", log.seed, "the same seed makes the same scene, flight and scans")
        ->required()
        ->group("Flight");
    app.add_option("--speed-m-s", log.speed_m_s, "on straights; turns are flown as slowly as asked")
        ->check(CLI::Range(0.1, 20.0))
        ->capture_default_str()
        ->group("Flight");
    app.add_option("--tilt-sd-deg", log.tilt_sd_deg,
                   "standard deviation of roll and of pitch; 0: a level flight")
        ->check(CLI::Range(0.0, 15.0))
        ->capture_default_str()
        ->group("Flight");
    app.add_flag("--clear-air", log.clear_air,
                 "no dust, and nothing of the vehicle in the sensor's view")
        ->group("Flight");
    app.add_option("--every-s", log.every_s, "from one scan's start to the next one's")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str()
        ->group("Flight");
    app.add_option("--sensor", log.sensor, "rawlogs hold packets of VLP-16 and HDL-32E")
        ->check(CLI::IsMember({"VLP-16", "HDL-32E", "HDL-64E"}))
        ->capture_default_str()
        ->group("Flight");

    app.add_option("-o,--output", log.rawlog, "rawlog: packets of each scan, and poses")
        ->check(not_empty)
        ->group("Output");
    app.add_option("--kitti", log.folder,
                   "scan folder with the truth: labels/, semantic/, kinds.yaml, altitudes.txt")
        ->check(not_empty)
        ->group("Output");
    app.add_option("--poses", log.poses, "where the vehicle was (TUM)")
        ->check(not_empty)
        ->group("Output");
    app.add_flag("--overwrite", log.overwrite, "replace outputs that exist")->group("Output");
    app.add_flag("-q,--quiet", is_quiet, "print errors only")->group("Output");
    app.set_version_flag("--version", "rawlog-simulate " HAGEN_VERSION);
}

/// What one flag alone cannot tell.
void check(const simulated_logs::SimulatedLog& log) {
    if (log.rawlog.empty() && log.folder.empty() && log.poses.empty()) {
        throw CLI::RequiredError("an output (-o, --kitti or --poses)");
    }
    if (log.sensor == "HDL-64E" && !log.rawlog.empty()) {
        throw CLI::ValidationError("-o",
                                   "holds packets, and there are none of HDL-64E; ask for "
                                   "--kitti alone");
    }
}

void printSummary(const simulated_logs::SimulatedLog& log,
                  const simulated_logs::SimulationReport& report) {
    std::cout << report.scans << " scans of " << log.scenario << " with " << report.returns
              << " returns: " << report.roi << " RoI, " << report.rou << " ROU, "
              << report.unclassified << " unclassified\n";
    for (const auto& output : {log.rawlog, log.folder, log.poses}) {
        if (!output.empty()) std::cout << output.string() << "\n";
    }
}

int fail(int exit_code, const std::string& message) {
    std::cerr << "rawlog-simulate: " << message << "\n";
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Examples:\n"
        "  rawlog-simulate --scenario orchard --scans 50 --altitude 2 --seed 1 -o flight.rawlog\n"
        "  rawlog-simulate --scenario wires --scans 12 --every-s 2 --altitude 4 --seed 7 --kitti "
        "wires\n"
        "\n"
        "Simulates a flight with a LiDAR over a made scene, and writes what it measures with the "
        "truth."};
    app.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    simulated_logs::SimulatedLog log;
    bool is_quiet = false;
    declare(app, log, is_quiet);
    try {
        app.parse(argc, argv);
        check(log);
        catchSignals();
        const simulated_logs::SimulationReport report =
            simulated_logs::simulateLog(log, [] { return !isInterrupted(); });
        if (!is_quiet) printSummary(log, report);
        if (std::fflush(stdout) != 0 || !std::cout.flush()) {
            return fail(kFailed, "the summary cannot be printed");
        }
        return 0;
    } catch (const CLI::Success& e) {  // --help, --version
        app.exit(e);
        const bool is_printed = std::fflush(stdout) == 0 && std::cout.flush();
        return is_printed ? 0 : fail(kFailed, "the text cannot be printed");
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kWrongUsage;
    } catch (const std::filesystem::filesystem_error& e) {
        return fail(kFailed, e.path1().string() + ": " + e.code().message());
    } catch (const std::exception& e) {
        return fail(kFailed, e.what());
    }
}
