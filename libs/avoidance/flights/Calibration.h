#pragma once
#include <hagen/avoidance/LatencyProfile.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::avoidance {

struct CalibrationOptions {
    std::vector<std::string> models;  ///< to measure
    int courses = 4;                  ///< of forest-0.05, forest-0.10, u-trap, movers, in turn
    std::function<void(const std::string& what)> doing;  ///< called before each model
    std::function<void()> continuing;  ///< called often during flights; may throw to end them
};

/// Flights that measure latencies are as fast as those that all scenarios are flown at: windows and
/// rolling maps are larger then. So latencies of slower flights are too long rather than too short.
constexpr double kCalibrated_m_s = 10;

/// Measures every stage's CPU time on this machine, in flights through these courses with every
/// guidance and planner. The flights themselves use latencies of kNominal_ms per stage. Nothing
/// else should run meanwhile. Throws std::invalid_argument for unknown names.
LatencyProfile calibrate(const CalibrationOptions& options);

constexpr double kNominal_ms = 10;
/// A profile in which every stage takes this long.
LatencyProfile constantProfile(double latency_ms);

/// Heap that a model holds after a distance flown.
struct HeapSample {
    double path_m, bytes;
};

/// The heap of a model along a flight of `path_m`, every 10 m: the scans of one flight through
/// forest-0.05, repeated end to end. `continuing` is called before each scan, and may throw to end
/// it.
std::vector<HeapSample> heapAlongFlight(const std::string& model, double path_m,
                                        const std::function<void()>& continuing = {});

/// Flies `path_m` with each model and writes its heap as CSV: model,path_m,bytes. `begin` is called
/// before each model, `continuing` before each scan; both may throw to end it. The file is written
/// at `place`, such as an OutputPath's temporary name; throws std::runtime_error, naming `file`, if
/// that fails.
void writeHeapCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const std::filesystem::path& place,
                     const std::filesystem::path& file);

}  // namespace hagen::avoidance
