#include <hagen/observations/MrptCompat.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <mrpt/core/initializer.h>

namespace hagen {

IMPLEMENTS_MRPT_OBJECT(ObservationSegmenter, mrpt::rtti::CObject, hagen)

MRPT_INITIALIZER(registerAllClasses_hagen_observations) { registerHagenClasses(); }

void registerHagenClasses() {
    mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(ObservationSegmenter, hagen));
}

namespace {

using mrpt::obs::CObservationPointCloud;

bool isSameSensor(const SensorModel& a, const SensorModel& b) {
    return a.elevations_rad == b.elevations_rad && a.min_range_m == b.min_range_m &&
           a.max_range_m == b.max_range_m;
}

/// The returns of `scan` among `indices`; those of a window that lie beyond it are older scans'.
CObservationPointCloud::Ptr cloudOf(const mrpt::obs::CObservation& observation,
                                    const std::string& suffix, const Scan& scan,
                                    const std::vector<std::uint32_t>& indices) {
    auto points = PortableCloud::Create();
    points->reserve(indices.size());
    for (const std::uint32_t i : indices) {
        if (i >= scan.size()) break;  // ascending
        points->insertPointFast(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
    }
    auto cloud = CObservationPointCloud::Create();
    cloud->timestamp = observation.timestamp;
    cloud->sensorLabel = observation.sensorLabel + suffix;
    cloud->sensorPose = mrpt::poses::CPose3D(observation.sensorPose());
    cloud->pointcloud = points;
    return cloud;
}

}  // namespace

void ObservationSegmenter::initialize(const Settings& settings) {
    if (settings.sensor.model) filterFor(settings.sensorModel(), settings.options);
    settings_ = settings;
    lidars_.clear();
}

ObservationSegmenter::Lidar& ObservationSegmenter::lidarOf(const std::string& label,
                                                           const SensorModel& sensor) {
    const auto known = lidars_.find(label);
    if (known != lidars_.end()) {
        if (isSameSensor(known->second.filter.sensor(), sensor)) return known->second;
        lidars_.erase(known);  // another sensor under the same label
    }
    Lidar lidar{filterFor(sensor, settings_.options),
                SlidingWindow(settings_.options.window_scans)};
    return lidars_.emplace(label, std::move(lidar)).first->second;
}

bool ObservationSegmenter::process(const mrpt::obs::CObservation& observation, Output& out,
                                   const std::optional<mrpt::poses::CPose3D>& vehicle_pose) {
    if (!isLidarScan(observation)) return false;
    const mrpt::system::CTimeLoggerEntry whole(profiler, "process");
    {
        const mrpt::system::CTimeLoggerEntry part(profiler, "process.read");
        readObservation(observation, settings_, observed_);
    }
    const Scan& scan = observed_.scan;
    Lidar& lidar = lidarOf(observation.sensorLabel, observed_.sensor);

    std::string remark = observed_.remark;
    const Scan* window = &scan;
    if (settings_.options.window_scans > 1 && vehicle_pose) {
        const mrpt::system::CTimeLoggerEntry part(profiler, "process.window");
        window = &lidar.window.add(
            scan, *vehicle_pose + mrpt::poses::CPose3D(observation.sensorPose()), observed_.sensor);
    } else if (settings_.options.window_scans > 1) {
        lidar.window.clear();
        remark += std::string(remark.empty() ? "" : "; ") +
                  "window_scans is above 1, but there is no pose: the scan is segmented alone";
    }
    if (!remark.empty()) logStr(mrpt::system::LVL_WARN, observation.sensorLabel + ": " + remark);

    profiler.enter("process.segment");
    const SegmentationResult& result = lidar.filter.segment(*window);
    profiler.leave("process.segment");

    const mrpt::system::CTimeLoggerEntry part(profiler, "process.clouds");
    out.roi = cloudOf(observation, "_roi", scan, result.returns.roi);
    out.non_roi = cloudOf(observation, "_non_roi", scan, result.returns.rou);
    out.scan = &scan;
    out.window = window;
    out.result = &result;
    out.sensor = &lidar.filter.sensor();
    out.is_sensor_assumed = observed_.is_sensor_assumed;
    out.remark = remark;
    return true;
}

}  // namespace hagen
