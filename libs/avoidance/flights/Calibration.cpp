#include "avoidance/flights/Calibration.h"
#include <hagen/avoidance/Trial.h>
#include <array>
#include <cmath>
#include <ctime>
#include "avoidance/flights/Stopwatch.h"
#include "base/NumberText.h"
#include "base/ProcessCost.h"
#include "base/Quantile.h"
#include "base/WriteFile.h"

namespace hagen::avoidance {
namespace {

const std::array<const char*, 4> kCourses{"forest-0.05", "forest-0.10", "u-trap", "movers"};

std::string processorName() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown processor";
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return text;
}

/// The scans of a flight, and the distance flown at each.
struct RecordedScans {
    std::vector<observations::MappedScan> scans;
    std::vector<double> path_m;
    double length_m = 0;
};

RecordedScans recordFlight(const Course& course, const std::function<void()>& continuing) {
    RecordedScans recorded;
    TrialListener listener;
    Eigen::Vector3d last = course.start_m;
    listener.moved = [&](double, const VehicleState& state) {
        recorded.length_m += (state.position_m - last).norm();
        last = state.position_m;
    };
    listener.step = [&](const TrialStep& step) {
        if (continuing) continuing();
        recorded.scans.push_back(step.scan);
        recorded.path_m.push_back(recorded.length_m);
    };
    runTrial(course, TrialSetup{}, constantProfile(kNominal_ms), nullptr, listener);
    return recorded;
}

/// Shifts a scan in space and time, for the next lap.
void moveOn(observations::MappedScan& scan, float by_m, double by_s) {
    scan.time_s += by_s;
    scan.origin_m.x() += by_m;
    for (Eigen::Vector3f& point : scan.points_m) point.x() += by_m;
}

}  // namespace

LatencyProfile constantProfile(double latency_ms) {
    LatencyProfile profile;
    TrialSetup setup;
    for (const std::string& model : worldModelNames()) {
        setup.model = model;
        for (const std::string& guidance : guidanceNames()) {
            setup.guidance = guidance;
            for (const std::string& planner : plannerNames()) {
                setup.planner = planner;
                for (const std::string& stage : stagesOf(setup)) {
                    profile.quantiles_ms[stage] = {latency_ms};
                }
            }
        }
    }
    return profile;
}

LatencyProfile calibrate(const CalibrationOptions& options) {
    const LatencyProfile nominal = constantProfile(kNominal_ms);
    TrialMeasurement measurement;
    TrialSetup setup;
    setup.speed_m_s = kCalibrated_m_s;
    TrialListener listener;
    listener.moved = [&](double, const VehicleState&) {
        if (options.continuing) options.continuing();
    };
    for (const std::string& model : options.models) {
        if (options.doing) options.doing(model);
        setup.model = model;
        for (int seed = 0; seed < options.courses; ++seed) {
            const Course course =
                makeCourse(kCourses[static_cast<std::size_t>(seed) % kCourses.size()],
                           static_cast<std::uint64_t>(seed));
            for (const std::string& guidance : guidanceNames()) {
                setup.guidance = guidance;
                for (const std::string& planner : plannerNames()) {
                    setup.planner = planner;
                    runTrial(course, setup, nominal, &measurement, listener);
                }
            }
        }
    }
    LatencyProfile profile;
    profile.machine = processorName();
    profile.made_by = "octomap-compare " HAGEN_VERSION;
    profile.date = today();
    for (const auto& [stage, taken_ms] : measurement.stage_ms) {
        profile.quantiles_ms[stage] = quantilesOf(taken_ms);
    }
    return profile;
}

std::vector<CostSample> costAlongFlight(const std::string& model, double path_m,
                                        const std::function<void()>& continuing) {
    constexpr double kEvery_m = 10;
    const Course course = makeCourse(kCourses[0], 0);
    RecordedScans recorded = recordFlight(course, continuing);
    WorldModelSetting setting;
    setting.bounds_m = course.bounds_m.cast<float>();
    setting.bounds_m.max().x() += static_cast<float>(path_m);
    setting.true_clearance_m = [](const Eigen::Vector3f&, double) { return WorldModel::kReach_m; };
    const double before = base::heapBytes();
    const auto world = makeWorldModel(model, setting);
    std::vector<CostSample> samples{{0, base::heapBytes() - before, 0}};
    double held = samples[0].bytes;
    std::vector<double> taken_ms;
    const double lap_s = recorded.scans.back().time_s;  // the first scan ends one turn after time 0
    for (double lap_m = 0; lap_m < path_m; lap_m += recorded.length_m) {
        for (std::size_t i = 0; i < recorded.scans.size(); ++i) {
            if (continuing) continuing();
            const double at_m = lap_m + recorded.path_m[i], heap = base::heapBytes();
            const double start_ms = base::threadCpuTime_ms();
            world->update(recorded.scans[i]);
            const double end_ms = base::threadCpuTime_ms();
            held += base::heapBytes() - heap;
            taken_ms.push_back(end_ms - start_ms);
            if (at_m <= path_m && at_m >= samples.back().path_m + kEvery_m) {
                samples.push_back({at_m, held, base::quantile(taken_ms, 0.5)});
                taken_ms.clear();
            }
            moveOn(recorded.scans[i], static_cast<float>(recorded.length_m), lap_s);
        }
    }
    return samples;
}

namespace fs = std::filesystem;

void writeCostCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const fs::path& place,
                     const fs::path& file) {
    std::ofstream out = base::openToWrite(place, file);
    out << "model,path_m,bytes,update_ms\n";
    for (const std::string& model : models) {
        begin(model);
        for (const CostSample& sample : costAlongFlight(model, path_m, continuing)) {
            out << model << "," << std::round(10 * sample.path_m) / 10 << ","
                << static_cast<long long>(sample.bytes) << ","
                << base::fixedText(sample.update_ms, 3) << "\n";
        }
    }
    base::closeWritten(out, file);
}

}  // namespace hagen::avoidance
