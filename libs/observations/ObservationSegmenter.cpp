#include <hagen/base/ProcessCost.h>
#include <hagen/observations/Deskew.h>
#include <hagen/observations/Mount.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>

namespace hagen::observations {

IMPLEMENTS_MRPT_OBJECT(ObservationSegmenter, mrpt::rtti::CObject, hagen::observations)

MRPT_INITIALIZER(registerAllClasses_hagen_observations) { registerHagenClasses(); }

void registerHagenClasses() {
    mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(ObservationSegmenter, hagen::observations));
    // The class name from before libraries had namespaces.
    mrpt::rtti::registerClassCustomName(
        "hagen::ObservationSegmenter",
        CLASS_ID_NAMESPACE(ObservationSegmenter, hagen::observations));
}

namespace {

using mrpt::obs::CObservationPointCloud;

bool isSameSensor(const SensorModel& a, const SensorModel& b) {
    return a.elevations_rad == b.elevations_rad && a.min_range_m == b.min_range_m &&
           a.max_range_m == b.max_range_m;
}

CObservationPointCloud::Ptr partOf(const mrpt::obs::CObservation& observation,
                                   const std::string& suffix,
                                   const mrpt::maps::CPointsMap::Ptr& points) {
    auto part = CObservationPointCloud::Create();
    part->timestamp = observation.timestamp;
    part->sensorLabel = observation.sensorLabel + suffix;
    part->sensorPose = mrpt::poses::CPose3D(observation.sensorPose());
    part->pointcloud = points;
    return part;
}

void append(const std::string& remark, std::string& remarks) {
    remarks += (remarks.empty() ? "" : "; ") + remark;
}

}  // namespace

void ObservationSegmenter::initialize(const Settings& settings) {
    if (settings.sensor.model) filterFor(settings.sensorModel(), settings.options);
    settings_ = settings;
    lidars_.clear();
    horizon_ = {};
}

ObservationSegmenter::Lidar& ObservationSegmenter::lidarOf(const std::string& label,
                                                           const SensorModel& sensor) {
    const auto known = lidars_.find(label);
    if (known != lidars_.end()) {
        if (isSameSensor(known->second.filter.sensor(), sensor)) return known->second;
        lidars_.erase(known);  // another sensor with the same label
    }
    Lidar lidar{filterFor(sensor, settings_.options),
                SlidingWindow(settings_.options.window_scans)};
    return lidars_.emplace(label, std::move(lidar)).first->second;
}

const Scan& ObservationSegmenter::windowOf(const mrpt::obs::CObservation& observation,
                                           const Trajectory& vehicle,
                                           const std::optional<mrpt::poses::CPose3D>& sensor_pose,
                                           Lidar& lidar, std::string& remark) {
    const Scan& scan = observed_.scan;
    if (settings_.options.window_scans == 1) return scan;
    if (!sensor_pose) {
        lidar.window.clear();
        append("window_scans is above 1, but the scan has no pose: it is segmented alone", remark);
        return scan;
    }
    const mrpt::system::CTimeLoggerEntry part(profiler, "process.window");
    const mrpt::poses::CPose3D sensor_on_vehicle(observation.sensorPose());
    deskewed_ = scan;
    // What has no range gets none by being moved.
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!hasValue(scan.range_m[i])) deskewed_.x_m[i] = kNoValue;
    }
    if (scan.time_s.empty()) {
        append("its returns have no times: it is not deskewed", remark);
    } else if (!deskew(vehicle, observation.timestamp, sensor_on_vehicle, observed_.sensor,
                       deskewed_)) {
        append("the poses do not cover the scan: it is not deskewed", remark);
    }
    return lidar.window.add(deskewed_, *sensor_pose, observed_.sensor);
}

bool ObservationSegmenter::process(const mrpt::obs::CObservation& observation, Output& out,
                                   const Trajectory& vehicle) {
    if (!isLidarScan(observation)) {
        see(observation);
        return false;
    }
    return process(observation, out, scanPoseOf(observation, vehicle, horizon_), vehicle);
}

bool ObservationSegmenter::process(const mrpt::obs::CObservation& observation, Output& out,
                                   const ScanPose& pose, const Trajectory& vehicle) {
    const auto start = std::chrono::steady_clock::now();
    if (!isLidarScan(observation)) return false;
    const mrpt::system::CTimeLoggerEntry whole(profiler, "process");
    {
        const mrpt::system::CTimeLoggerEntry part(profiler, "process.read");
        readObservation(observation, settings_, observed_);
    }
    const std::size_t returns_masked = maskAirframe(settings_.airframe.parts, observed_.scan);
    const Scan& scan = observed_.scan;
    Lidar& lidar = lidarOf(observation.sensorLabel, observed_.sensor);

    const std::optional<Attitude> tilt =
        sensorTilt(pose, mrpt::poses::CPose3D(observation.sensorPose()), settings_.mount);

    std::string remark = observed_.remark;
    const Scan& window = windowOf(observation, vehicle, pose.sensor_pose, lidar, remark);
    if (!remark.empty()) logStr(mrpt::system::LVL_WARN, observation.sensorLabel + ": " + remark);

    std::optional<mrpt::system::CTimeLoggerEntry> segmenting(std::in_place, profiler,
                                                             "process.segment");
    const auto cpu_start = base::threadCpuTime();
    const SegmentationResult& result = lidar.filter.segment(window, tilt);
    const auto filter_cpu_time = base::threadCpuTime() - cpu_start;
    segmenting.reset();
    const auto labelled = std::chrono::steady_clock::now();

    const mrpt::system::CTimeLoggerEntry part(profiler, "process.clouds");
    // Indices past the scan belong to older scans of the window.
    out.roi = partOf(observation, "_roi", cloudOf(scan, result.returns.roi, cloud_class));
    out.non_roi = partOf(observation, "_non_roi", cloudOf(scan, result.returns.rou, cloud_class));
    out.scan = &scan;
    out.window = &window;
    out.result = &result;
    out.sensor = &lidar.filter.sensor();
    out.is_sensor_assumed = observed_.is_sensor_assumed;
    out.pose = pose;
    out.pose.attitude = tilt;
    out.remark = remark;
    out.returns_masked = returns_masked;
    out.time_to_labels = labelled - start;
    out.filter_cpu_time = filter_cpu_time;
    return true;
}

}  // namespace hagen::observations
