#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::trials {

struct CalibrationOptions {
    std::vector<std::string> models;  ///< those to measure
    int courses = 3;                  ///< of forest-0.05, forest-0.10, u-trap, in turn
    std::function<void(const std::string& what)> doing;  ///< told before each model
};

/// Measures every stage's CPU time on this machine, in flights of those courses with both
/// guidances and both planners. The flights themselves are under latencies of kNominal_ms a stage.
/// To be run where nothing else runs. Throws std::invalid_argument for unknown names.
LatencyProfile calibrate(const CalibrationOptions& options);

constexpr double kNominal_ms = 10;
/// A profile whose stages all take so long.
LatencyProfile constantProfile(double latency_ms);

/// How much of the heap a model holds after a way.
struct HeapSample {
    double path_m, bytes;
};

/// What a model holds along a flight of `path_m`: one flight's scans through forest-0.05, over and
/// over, each time where the last one ended. Every 10 m.
std::vector<HeapSample> heapAlongFlight(const std::string& model, double path_m);

}  // namespace hagen::trials
