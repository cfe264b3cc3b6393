#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>
#include "base/NumberText.h"
#include "base/ProcessCost.h"
#include "mrpt/Mount.h"
#include "mrpt/Results.h"

#include <chrono>
#include <optional>
#include <string>

namespace hagen::observations {

IMPLEMENTS_MRPT_OBJECT(ObservationSegmenter, mrpt::rtti::CObject, hagen::observations)

MRPT_INITIALIZER(registerAllClasses_hagen_observations) { registerHagenClasses(); }

void registerHagenClasses() {
    mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(ObservationSegmenter, hagen::observations));
    // The former class name, without namespace.
    mrpt::rtti::registerClassCustomName(
        "hagen::ObservationSegmenter",
        CLASS_ID_NAMESPACE(ObservationSegmenter, hagen::observations));
}

namespace {

using mrpt::obs::CObservationPointCloud;

constexpr std::chrono::seconds kMaxGap{1};  // between scans of a window

bool isSameSensor(const SensorModel& a, const SensorModel& b) {
    return a.elevations_rad == b.elevations_rad && a.min_range_m == b.min_range_m &&
           a.max_range_m == b.max_range_m && a.has_rings == b.has_rings;
}

/// Whether two sets of options are equal. Compares only the options that depend on the sensor.
bool areSameFor(const Options& a, const Options& b) {
    return a.columns == b.columns && a.window_size == b.window_size &&
           a.principal_components == b.principal_components;
}

}  // namespace

void ObservationSegmenter::initialize(const Settings& settings) {
    if (settings.sensor.model) filterFor(settings.sensorModel(), settings.options);
    settings_ = settings;
    windows_.clear();
    last_time_.clear();
    horizon_.forget();
    sensors_ = {};
}

SharedBeams ObservationSegmenter::beamsOf(const mrpt::obs::CObservation& observation) {
    if (settings_.sensor.model) return nullptr;
    showCloud(observation, sensors_);
    return sensors_.beamsOf(observation.sensorLabel);
}

/// Returns the window and filter for the most recently read scan.
SlidingWindow& ObservationSegmenter::windowOf(const std::string& label) {
    const SensorModel& sensor = observed_.sensor;
    const Options options = settings_.optionsFor(observed_.recovered.get());
    const auto known = windows_.find(label);
    if (known != windows_.end()) {
        const HagenFilter& filter = known->second.filter();
        if (isSameSensor(filter.sensor(), sensor) && areSameFor(filter.options(), options))
            return known->second;
        windows_.erase(known);  // another sensor with the same label
    }
    return windows_.emplace(label, SlidingWindow(filterFor(sensor, options))).first->second;
}

bool ObservationSegmenter::process(const mrpt::obs::CObservation& observation, Output& out,
                                   const Trajectory& vehicle) {
    if (!isLidarScan(observation)) {
        see(observation);
        return false;
    }
    return process(observation, out, scanPoseOf(observation, vehicle, horizon_));
}

bool ObservationSegmenter::process(const mrpt::obs::CObservation& observation, Output& out,
                                   const ScanPose& pose, const std::optional<SharedBeams>& beams) {
    const auto start = std::chrono::steady_clock::now();
    if (!isLidarScan(observation)) return false;
    const mrpt::system::CTimeLoggerEntry whole(profiler, "process");
    {
        const mrpt::system::CTimeLoggerEntry part(profiler, "process.read");
        readObservation(observation, settings_, observed_, beams ? *beams : beamsOf(observation));
    }
    const std::size_t returns_masked = maskAirframe(settings_.airframe.parts, observed_.scan);
    SlidingWindow& window = windowOf(observation.sensorLabel);
    auto& last = last_time_[observation.sensorLabel];
    const auto since = observation.timestamp - last;
    if (since < std::chrono::seconds(0) || since > kMaxGap) window.forget();
    last = observation.timestamp;

    const ScanPose mounted =
        mountedPose(pose, mrpt::poses::CPose3D(observation.sensorPose()), settings_.mount);

    std::string& remark = observed_.remark;
    std::optional<Eigen::Isometry3d> map_from_sensor;
    if (mounted.sensor_pose) {
        map_from_sensor = Eigen::Isometry3d(
            mounted.sensor_pose->getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
    }
    if (!remark.empty()) logStr(mrpt::system::LVL_WARN, observation.sensorLabel + ": " + remark);

    std::optional<mrpt::system::CTimeLoggerEntry> segmenting(std::in_place, profiler,
                                                             "process.segment");
    const auto cpu_start = base::threadCpuTime();
    const SegmentationResult& result =
        window.segment(observed_.scan, mounted.attitude, map_from_sensor);
    const auto filter_cpu_time = base::threadCpuTime() - cpu_start;
    segmenting.reset();
    const Scan& scan = window.labelled();
    if (const std::size_t unknown = window.scansWithoutMotion()) {
        remark +=
            std::string(remark.empty() ? "" : "; ") + "window: unknown motion since " +
            base::counted(unknown, "older scan") +
            (window.filter().options().window_fills_gaps ? ", not used" : ", used as measured");
    }
    const auto labelled = std::chrono::steady_clock::now();

    const mrpt::system::CTimeLoggerEntry part(profiler, "process.clouds");
    out.roi = resultOf(observation, true, cloudOf(scan, result.returns.roi, cloud_class));
    out.non_roi = resultOf(observation, false, cloudOf(scan, result.returns.rou, cloud_class));
    out.scan = &scan;
    out.result = &result;
    out.sensor = &window.filter().sensor();
    out.options = &window.filter().options();
    out.recovered = observed_.recovered;
    out.is_sensor_assumed = observed_.is_sensor_assumed;
    out.pose = mounted;
    out.remark = remark;
    out.returns_masked = returns_masked;
    out.time_to_labels = labelled - start;
    out.filter_cpu_time = filter_cpu_time;
    return true;
}

}  // namespace hagen::observations
