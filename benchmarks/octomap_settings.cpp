// Flies OctoMaps with various settings in closed loop. The update latency of each is first measured
// on the courses of seed 300 at a constant latency, then used on all seeds.
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Trial.h>
#include <hagen/avoidance/WorldModel.h>
#include "avoidance/flights/Calibration.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace hagen;

constexpr std::uint64_t kFirstSeed = 300;  // first tuning seed
const std::vector<std::string> kScenarios{"movers", "wires", "gap", "forest-0.10"};

/// Parses settings such as "resolution=0.4,hit=0.9,range=12".
observations::ScanMapOptions optionsFrom(const std::string& text) {
    observations::ScanMapOptions options;
    options.content = observations::MapContent::Full;
    std::istringstream in(text);
    for (std::string entry; std::getline(in, entry, ',');) {
        const std::size_t equals = entry.find('=');
        const std::string key = entry.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : entry.substr(equals + 1);
        if (key == "insertion") {
            if (value != "octomap" && value != "octomap-discrete") {
                throw std::invalid_argument("insertion=" + value +
                                            ": expected octomap or octomap-discrete");
            }
            options.insertion = value == "octomap" ? observations::RayInsertion::OctoMap
                                                   : observations::RayInsertion::OctoMapDiscrete;
            continue;
        }
        double* const setting = key == "resolution" ? &options.resolution_m
                                : key == "range"    ? &options.max_range_m
                                : key == "hit"      ? &options.hit_probability
                                : key == "miss"     ? &options.miss_probability
                                : key == "least"    ? &options.min_probability
                                : key == "greatest" ? &options.greatest_probability
                                                    : nullptr;
        char* end = nullptr;
        const double number = std::strtod(value.c_str(), &end);
        if (setting == nullptr || value.empty() || *end != '\0') {
            throw std::invalid_argument("'" + entry +
                                        "': expected resolution, range, hit, miss, least, greatest "
                                        "or insertion, each =VALUE");
        }
        *setting = number;
    }
    return options;
}

void fly(const std::string& settings, const std::vector<std::string>& scenarios, int seeds,
         bool only_measures) {
    const observations::ScanMapOptions options = optionsFrom(settings);
    avoidance::TrialSetup setup;
    setup.model = "O-Full-0.4";
    setup.make_world = [&](const avoidance::WorldModelSetting& world) {
        return avoidance::makeOctoMap(options, world.bounds_m);
    };
    avoidance::TrialMeasurement measured;
    for (const std::string& scenario : scenarios) {
        avoidance::runTrial(avoidance::makeCourse(scenario, kFirstSeed), setup,
                            avoidance::constantProfile(avoidance::kNominal_ms), &measured);
    }
    avoidance::LatencyProfile profile = avoidance::standardLatencyProfile();
    for (const auto& [stage, taken_ms] : measured.stage_ms) {
        if (stage != "filter") profile.quantiles_ms[stage] = avoidance::quantilesOf(taken_ms);
    }
    std::printf("%-44s", settings.empty() ? "(defaults)" : settings.c_str());
    int total = 0, stops = 0;
    for (const std::string& scenario : only_measures ? std::vector<std::string>{} : scenarios) {
        int successes = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const avoidance::TrialResult result = avoidance::runTrial(
                avoidance::makeCourse(scenario, kFirstSeed + static_cast<std::uint64_t>(seed)),
                setup, profile);
            successes += result.outcome == avoidance::Outcome::Success;
            stops += result.emergency_stops;
        }
        total += successes;
        std::printf(" %11d", successes);
        std::fflush(stdout);
    }
    const std::string update = setup.model + "/update";
    std::printf(" %7d %7d %8.1f %8.1f\n", total, stops, profile.median_ms(update),
                profile.at_ms(update, 0.95));
    std::fflush(stdout);
}

int usage() {
    std::cerr << "usage: octomap-settings [--scenario LIST] [--seeds N] [--only-measure] "
                 "SETTINGS...\nSETTINGS: such as resolution=0.4,hit=0.9,miss=0.45,range=12; '' for "
                 "the defaults\n";
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenarios = kScenarios, settings;
    int seeds = 5;
    bool only_measures = false;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--only-measure") {
            only_measures = true;
        } else if (argument == "--seeds" && i + 1 < argc) {
            seeds = std::atoi(argv[++i]);
        } else if (argument == "--scenario" && i + 1 < argc) {
            scenarios.clear();
            std::istringstream in(argv[++i]);
            for (std::string name; std::getline(in, name, ',');) scenarios.push_back(name);
        } else if (argument.rfind("--", 0) == 0) {
            return usage();
        } else {
            settings.push_back(argument);
        }
    }
    if (settings.empty() || seeds < 1) return usage();
    try {
        std::printf("%-44s", ("successes of " + std::to_string(seeds)).c_str());
        for (const auto& scenario : scenarios) {
            if (!only_measures) std::printf(" %11s", scenario.c_str());
        }
        std::printf(" %7s %7s %8s %8s\n", "all", "stops", "ms p50", "p95");
        for (const std::string& text : settings) fly(text, scenarios, seeds, only_measures);
    } catch (const std::exception& error) {
        std::cerr << "octomap-settings: " << error.what() << "\n";
        return 2;
    }
}
