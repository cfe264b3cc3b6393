#include "Flights.h"

#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <chrono>

#include "StageRows.h"
#include "evaluation/labelled_folders/Methods.h"

namespace hagen {
namespace {

constexpr double kScanPeriod_s = 0.1;

std::vector<evaluation::Method> methods() {
    Settings ours, fast, papers;
    fast.options = fastOptions();
    papers.options = paperOptions();
    std::vector<evaluation::Method> all;
    for (const evaluation::Method& method :
         evaluation::methodsFor({{{"hagen, paper", papers, "", ""},
                                  {"hagen, default", ours, "", ""},
                                  {"hagen, fast", fast, "", ""}},
                                 ours},
                                "")) {
        const bool is_tuned = method.name.find("tuned") != std::string::npos;
        if (!is_tuned) all.push_back(method);
    }
    return all;
}

}  // namespace

FlightTimes timeFlight(const std::string& scenario, std::uint64_t seed, int scans) {
    const SensorModel sensor = sensorModel("VLP-16");
    const simulation::Scene scene = simulation::makeScene(scenario, seed);
    const simulation::Flight flight(scene.terrain(), scene.path(), {}, seed);
    simulation::Random random(seed, 3);
    const std::vector<evaluation::Method> all = methods();
    FlightTimes times{scenario, {}, {}};
    for (const evaluation::Method& method : all) times.methods.push_back({method.name, {}});
    for (int scan = 0; scan < scans; ++scan) {
        const evaluation::ScanInput input{
            simulation::simulateScan(scene, sensor, flight, kScanPeriod_s * scan, random).scan, {}};
        times.returns.push_back(input.scan.size());
        for (std::size_t m = 0; m < all.size(); ++m) {
            if (scan == 0) all[m].segment(input);  // warm-up
            const auto start = std::chrono::steady_clock::now();
            all[m].segment(input);
            const std::chrono::duration<double, std::milli> took =
                std::chrono::steady_clock::now() - start;
            times.methods[m].runs_ms.push_back(took.count());
        }
    }
    return times;
}

}  // namespace hagen
