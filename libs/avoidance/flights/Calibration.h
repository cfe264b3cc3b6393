#pragma once
#include <hagen/avoidance/LatencyProfile.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::avoidance {

struct CalibrationOptions {
    std::vector<std::string> models;  ///< models to measure
    int courses = 4;                  ///< from forest-0.05, forest-0.10, u-trap, movers, in turn
    std::function<void(const std::string& what)> doing;  ///< called before each model
    std::function<void()> continuing;  ///< called often during flights; may throw to abort
};

/// Speed of the calibration flights: the maximum of the reference campaign. Windows and rolling
/// maps grow with speed, so the latencies of slower flights are overestimated rather than
/// underestimated.
constexpr double kCalibrated_m_s = 12;

/// Measures every stage's CPU time on this machine, in flights through these courses with every
/// guidance and planner. The flights themselves use latencies of kNominal_ms per stage. The machine
/// should be otherwise idle. Throws std::invalid_argument for unknown names.
LatencyProfile calibrate(const CalibrationOptions& options);

constexpr double kNominal_ms = 10;
/// A profile with this latency for every stage.
LatencyProfile constantProfile(double latency_ms);

/// Heap used by a model after a distance flown, and the median CPU time of the updates since the
/// previous sample (0 for the first).
struct CostSample {
    double path_m, bytes, update_ms;
};

/// The cost of a model along a flight of `path_m`, every 10 m: the scans of one flight through
/// forest-0.05, repeated end to end. `continuing` is called before each scan, and may throw to
/// abort.
std::vector<CostSample> costAlongFlight(const std::string& model, double path_m,
                                        const std::function<void()>& continuing = {});

/// Flies `path_m` with each model and writes CSV: model,path_m,bytes,update_ms. `begin` is called
/// before each model, `continuing` before each scan; both may throw to abort. Writes to `place`,
/// such as an OutputPath's temporary name; throws std::runtime_error, naming `file`, on failure.
void writeCostCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const std::filesystem::path& place,
                     const std::filesystem::path& file);

}  // namespace hagen::avoidance
