// Simulates a flight with a LiDAR over a scene, and writes what it measures with the truth.
#include <hagen/range_image/Angle.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>

#include "TruthFolder.h"

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;

struct CommandLine {
    std::string scenario, sensor = "VLP-16", folder;
    int scans = 0;
    double altitude_m = 2, speed_m_s = 4, tilt_sd_deg = 4, every_s = 0.1;
    std::uint64_t seed = 1;
    bool overwrite = false, is_quiet = false;
};

mrpt::poses::CPose3D mrptPose(const SensorPose& pose) {
    const Eigen::Quaterniond& q = pose.attitude;
    return {mrpt::math::CQuaternionDouble(q.w(), q.x(), q.y(), q.z()), pose.position_m.x(),
            pose.position_m.y(), pose.position_m.z()};
}

void simulate(const CommandLine& line) {
    const Scene scene = makeScene(line.scenario, line.seed);
    const SensorModel sensor = sensorModel(line.sensor);
    FlightSettings settings;
    settings.altitude_m = line.altitude_m;
    settings.speed_m_s = line.speed_m_s;
    settings.tilt_sd_rad = radians(line.tilt_sd_deg);
    const Flight flight(scene.terrain(), scene.path(), settings, line.seed);
    TruthFolder folder(line.folder, line.overwrite);
    Random random(line.seed, 3);
    for (int scan = 0; scan < line.scans; ++scan) {
        const double time_s = line.every_s * scan;
        const SimulatedScan made = simulateScan(scene, sensor, flight, time_s, random);
        folder.write(made.scan, {made.kind, made.object}, sensor, time_s, mrptPose(made.pose),
                     made.altitude_m);
    }
    folder.commit();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Simulates a flight with a LiDAR, and writes its scans with true labels."};
    app.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    CommandLine line;
    app.add_option("--scenario", line.scenario)->required()->check(CLI::IsMember(scenarioNames()));
    app.add_option("--scans", line.scans)->required()->check(CLI::Range(1, 1000000));
    app.add_option("--altitude", line.altitude_m)->check(CLI::Range(1.0, 15.0));
    app.add_option("--seed", line.seed);
    app.add_option("--kitti", line.folder)->required();
    app.add_option("--sensor", line.sensor)->check(CLI::IsMember({"VLP-16", "HDL-32E", "HDL-64E"}));
    app.add_option("--tilt-sd-deg", line.tilt_sd_deg)->check(CLI::Range(0.0, 15.0));
    app.add_option("--speed-m-s", line.speed_m_s)->check(CLI::Range(0.1, 20.0));
    app.add_option("--every-s", line.every_s)->check(CLI::Range(0.1, 3600.0));
    app.add_flag("--overwrite", line.overwrite);
    app.add_flag("-q,--quiet", line.is_quiet);
    try {
        app.parse(argc, argv);
        simulate(line);
        return 0;
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kWrongUsage;
    } catch (const std::exception& e) {
        std::cerr << "rawlog-simulate: " << e.what() << "\n";
        return kFailed;
    }
}
