// Simulates a flight with a LiDAR over a scene, and writes the scans with ground truth.
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>

#include "base/NumberText.h"
#include "base/command_line/CommandLine.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/ProgressLine.h"
#include "convert/simulated/SimulatedLog.h"

namespace {

using namespace hagen;
using namespace hagen::base;

void declare(Program& app, convert::SimulatedLog& log, bool& is_quiet) {
    std::string known;
    for (const std::string& scenario : simulation::scenarioNames()) {
        known += (known.empty() ? "" : ", ") + scenario;
    }
    const auto known_scenario = [known](const std::string& name) -> std::string {
        const auto names = simulation::scenarioNames();
        if (std::find(names.begin(), names.end(), name) != names.end()) return "";
        return "unknown scenario '" + name + "'; known: " + known;
    };

    app.option("--scenario", log.scenario, "the scene: " + known)
        .required()
        .check(known_scenario)
        .group("Flight");
    app.option("--scans", log.scans, "number of scans")
        .required()
        .between(1, 100000)
        .group("Flight");
    app.option("--altitude", log.altitude_m, "metres above the ground")
        .required()
        .between(0.2, 15.0)
        .group("Flight");
    app.option("--seed", log.seed, "the same seed gives the same scene, flight and scans")
        .required()
        .group("Flight");
    app.option("--speed-m-s", log.speed_m_s, "speed on straights; turns may be slower")
        .between(0.1, 20.0)
        .showDefault()
        .group("Flight");
    app.option("--tilt-sd-deg", log.tilt_sd_deg,
               "standard deviation of roll and pitch; 0: level flight")
        .between(0.0, 15.0)
        .showDefault()
        .group("Flight");
    app.flag("--clear-air", log.clear_air, "no dust, and no returns of the vehicle itself")
        .group("Flight");
    app.option("--every-s", log.every_s, "time between scan starts")
        .between(0.1, 3600.0)
        .showDefault()
        .group("Flight");
    app.option("--sensor", log.sensor, "rawlogs do not support HDL-64E")
        .oneOf({"VLP-16", "HDL-32E", "HDL-64E", "Mid-360", "Avia", "HAP"})
        .showDefault()
        .group("Flight");
    app.option("--mount-roll-deg", log.mount_roll_deg,
               "the sensor's roll on the vehicle; 180: upside down")
        .between(-180.0, 180.0)
        .showDefault()
        .group("Flight");
    app.option("--mount-pitch-deg", log.mount_pitch_deg,
               "the sensor's pitch on the vehicle; positive: tilted forward and down")
        .between(-90.0, 90.0)
        .showDefault()
        .group("Flight");

    app.option("-o,--output", log.rawlog, "rawlog with packets (Livox: clouds) and poses")
        .group("Output");
    app.option("--kitti", log.folder,
               "scan folder with ground truth: labels/, semantic/, kinds.yaml, altitudes.txt")
        .group("Output");
    app.option("--poses", log.poses, "vehicle trajectory (TUM)").group("Output");
    app.option("--pcap", log.capture,
               "network capture of the packets (VLP-16, HDL-32E), for live-segment --replay")
        .extension({".pcap"})
        .group("Output");
    app.flag("--overwrite", log.overwrite, "replace existing outputs").group("Output");
    app.flag("-q,--quiet", is_quiet, "print errors only").group("Output");
    app.version(HAGEN_VERSION);
}

/// Rejects invalid combinations of flags.
void check(const convert::SimulatedLog& log) {
    if (log.rawlog.empty() && log.folder.empty() && log.poses.empty() && log.capture.empty()) {
        throw UsageError("an output (-o, --kitti, --poses or --pcap) is required");
    }
    if (!log.capture.empty() && log.sensor != "VLP-16" && log.sensor != "HDL-32E") {
        throw UsageError("--pcap", "does not support " + log.sensor);
    }
    if (log.sensor == "HDL-64E" && !log.rawlog.empty()) {
        throw UsageError("-o", "does not support HDL-64E; use only --kitti");
    }
}

void printSummary(const convert::SimulatedLog& log, const convert::SimulationReport& report) {
    std::cout << counted(static_cast<std::size_t>(report.scans), "scan") << " of " << log.scenario
              << " with " << report.returns << " returns: " << report.roi << " RoI, " << report.rou
              << " ROU, " << report.unclassified << " unclassified\n";
    for (const auto& output : {log.rawlog, log.folder, log.poses, log.capture}) {
        if (!output.empty()) std::cout << output.string() << "\n";
    }
}

int run(const convert::SimulatedLog& log, bool is_quiet) {
    check(log);
    catchSignals();
    ProgressLine progress("scan");
    const auto start = std::chrono::steady_clock::now();
    std::size_t begun = 0;
    const auto keep_going = [&] {
        ++begun;
        const bool is_long = std::chrono::steady_clock::now() - start > std::chrono::seconds(2);
        if (!is_quiet && is_long) progress.show(begun, static_cast<std::size_t>(log.scans));
        return !isInterrupted();
    };
    const convert::SimulationReport report = convert::simulateLog(log, keep_going);
    if (!is_quiet) printSummary(log, report);
    return kDone;
}

int command(int argc, char** argv) {
    Program program(
        "rawlog-simulate",
        "Simulates a flight with a LiDAR over a generated scene, and writes its scans with ground "
        "truth.");
    program.footer(
        "Examples (each on one line):\n"
        "  rawlog-simulate --scenario orchard --scans 50 --altitude 2 --seed 1\n"
        "    -o flight.rawlog\n"
        "  rawlog-simulate --scenario wires --scans 12 --every-s 2 --altitude 4 --seed 7\n"
        "    --kitti wires\n"
        "  rawlog-simulate --scenario orchard --scans 300 --altitude 2 --seed 1\n"
        "    --pcap flight.pcap\n"
        "Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    convert::SimulatedLog log;
    bool is_quiet = false;
    declare(program, log, is_quiet);
    return program.run(argc, argv, [&] { return run(log, is_quiet); });
}

}  // namespace

int main(int argc, char** argv) { return guarded(argc, argv, command); }
