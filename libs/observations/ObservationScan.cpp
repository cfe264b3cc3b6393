#include <hagen/observations/DepthCamera.h>
#include <hagen/observations/LocatedCloud.h>
#include <hagen/observations/MrptCompat.h>
#include <hagen/observations/ObservationScan.h>
#include <hagen/observations/Results.h>
#include <hagen/observations/RotatingScan.h>
#include <hagen/observations/TableCloud.h>
#include <hagen/observations/VelodyneDecoder.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;

template <class Coordinates>
void assignPoints(const Coordinates& x, const Coordinates& y, const Coordinates& z, Scan& scan) {
    scan.x_m.assign(x.begin(), x.end());
    scan.y_m.assign(y.begin(), y.end());
    scan.z_m.assign(z.begin(), z.end());
    scan.intensity.assign(x.size(), 0.0f);
    scan.time_s.clear();
}

/// Scales intensities to 0..1 if the cloud's range is 0..255, as with many drivers.
template <class Intensities>
void assignIntensities(const Intensities& intensities, Scan& scan) {
    const auto most = std::max_element(intensities.begin(), intensities.end());
    const float full = most != intensities.end() && *most > 1.0f ? 255.0f : 1.0f;
    scan.intensity.resize(intensities.size());
    std::transform(intensities.begin(), intensities.end(), scan.intensity.begin(),
                   [&](float intensity) { return std::clamp(intensity / full, 0.0f, 1.0f); });
}

bool isSame(const Settings::Sensor& a, const Settings::Sensor& b) {
    return a.model == b.model && a.elevations_deg == b.elevations_deg &&
           a.min_range_m == b.min_range_m && a.max_range_m == b.max_range_m;
}

/// Takes the sensor of a cloud; rebuilds it, which allocates, only if it changed.
void takeCloudSensor(const Settings& settings, const SharedBeams& beams, ObservedScan& observed) {
    ObservedScan::Workspace& work = observed.work;
    if (!work.settings || !isSame(*work.settings, settings.sensor) || work.beams != beams) {
        work.settings.reset();
        work.sensor_of_settings = settings.sensorModel(beams.get());
        work.settings = settings.sensor;
        work.beams = beams;
    }
    observed.sensor = work.sensor_of_settings;
    if (!settings.sensor.model) observed.recovered = beams;
    observed.is_sensor_assumed = !settings.sensor.model && !beams;
}

void readPoints(const CObservationVelodyneScan& observation, Scan& scan) {
    const auto& cloud = observation.point_cloud;
    for (const std::size_t size : {cloud.y.size(), cloud.z.size(), cloud.intensity.size()}) {
        if (size == cloud.x.size()) continue;
        throw std::runtime_error("the arrays of its point cloud differ in size");
    }
    assignPoints(cloud.x, cloud.y, cloud.z, scan);
    std::transform(cloud.intensity.begin(), cloud.intensity.end(), scan.intensity.begin(),
                   [](std::uint8_t intensity) { return static_cast<float>(intensity) / 255.0f; });
}

void readPoints(const CObservationPointCloud& observation, Scan& scan) {
    observation.load();
    if (!observation.pointcloud)
        throw std::runtime_error("the observation contains no point cloud");
    const mrpt::maps::CPointsMap& cloud = *observation.pointcloud;
    assignPoints(cloud.getPointsBufferRef_x(), cloud.getPointsBufferRef_y(),
                 cloud.getPointsBufferRef_z(), scan);
    if (const auto* intensities = intensitiesOf(cloud)) assignIntensities(*intensities, scan);
}

/// Names the fields of a newer MRPT's cloud that get lost.
std::string remarkOnFields(const CObservationPointCloud& observation) {
    const std::vector<std::string> fields = fieldsNotKept(*observation.pointcloud);
    std::string names;
    for (const std::string& field : fields) names += (names.empty() ? "" : ", ") + field;
    if (names.empty()) return "";
    return "the filter does not use these fields of its cloud; --cloud generic, --clouds and "
           "--mcap "
           "keep them: " +
           names;
}

const LocatedCloud* locatedCloudOf(const mrpt::obs::CObservation& observation) {
    const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation);
    return cloud == nullptr ? nullptr : dynamic_cast<const LocatedCloud*>(cloud->pointcloud.get());
}

/// The rows of the rings that a cloud's returns are numbered with, where these are known.
void takeRings(const std::vector<std::int32_t>& rings, const std::vector<int>& row_of_ring,
               Scan& scan) {
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const auto ring = static_cast<std::size_t>(rings[i]);
        if (ring >= row_of_ring.size() || row_of_ring[ring] < 0) continue;
        scan.row[i] = static_cast<std::uint8_t>(row_of_ring[ring]);
    }
}

/// The recording's own sensor is used, but for its range limits: those are of its driver, and all
/// returns are there.
void takeOwnSensor(const Settings& settings, ObservedScan& observed) {
    SensorModel& sensor = observed.sensor;
    sensor.min_range_m = settings.sensor.min_range_m.value_or(sensor.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(sensor.max_range_m);
    if (settings.sensor.model && settings.sensor.model != sensor.name) {
        observed.remark = "the packets are of the sensor " + sensor.name +
                          ": its beams are used instead of the settings' sensor.model " +
                          *settings.sensor.model;
    }
}

/// Reads a cloud that knows its beams.
void readLocated(const CObservationPointCloud& observation, const LocatedCloud& cloud,
                 const Settings& settings, ObservedScan& observed) {
    observed.sensor = cloud.sensor();
    takeOwnSensor(settings, observed);
    readPoints(observation, observed.scan);
    locateBeams(observed.sensor, observed.scan);
    observed.scan.row = cloud.rows();  // exact, also for near returns
    observed.scan.time_s = cloud.times_s();
}

void readRotating(const mrpt::obs::CObservationRotatingScan& observation, const Settings& settings,
                  const SharedBeams& beams, ObservedScan& observed) {
    RotatingReturns& returns = observed.work.rotating;
    if (organizedPointsOf(observation) == nullptr) {
        readRangeImage(observation, settings, observed.scan, observed.sensor, returns);
    } else {
        readOrganizedPoints(observation, observed.scan, returns);
        takeCloudSensor(settings, beams, observed);
        if (!settings.sensor.model) takeLimits(observation, settings, observed.sensor);
        locateBeams(observed.sensor, observed.scan);
        if (observed.recovered) {
            takeRings(returns.image_row, observed.recovered->row_of_ring, observed.scan);
        }
    }
    observed.remark = returns.remark;
}

void readPackets(const CObservationVelodyneScan& observation, const Settings& settings,
                 ObservedScan& observed) {
    sensorOf(observation, observed.sensor);
    takeOwnSensor(settings, observed);
    const std::size_t unsound_blocks =
        decodePackets(observation, observed.scan, observed.work.decoder);
    if (unsound_blocks > 0) {
        observed.remark = std::to_string(unsound_blocks) + " of " +
                          std::to_string(observation.scan_packets.size() * 12) +
                          " packet blocks have no valid header or azimuth and are skipped";
    }
}

}  // namespace

bool isLidarScan(const mrpt::obs::CObservation& observation) {
    if (isResult(observation)) return false;
    return dynamic_cast<const CObservationVelodyneScan*>(&observation) != nullptr ||
           dynamic_cast<const CObservationPointCloud*>(&observation) != nullptr ||
           rotatingScanOf(observation) != nullptr || depthScanOf(observation) != nullptr;
}

bool isCloud(const mrpt::obs::CObservation& observation) {
    if (!isLidarScan(observation) || locatedCloudOf(observation) != nullptr) return false;
    if (const auto* rotating = rotatingScanOf(observation)) {
        return organizedPointsOf(*rotating) != nullptr;
    }
    const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&observation);
    return velodyne == nullptr || velodyne->scan_packets.empty();
}

bool readCloudPoints(const mrpt::obs::CObservation& observation, Scan& scan,
                     std::vector<std::int32_t>* rings) {
    if (!isCloud(observation)) return false;
    if (rings != nullptr) rings->clear();
    if (const auto* rotating = rotatingScanOf(observation)) {
        RotatingReturns returns;
        readOrganizedPoints(*rotating, scan, returns);
        if (rings != nullptr) *rings = std::move(returns.image_row);
    } else if (const auto* depth = depthScanOf(observation)) {
        readDepthScan(*depth, scan);
    } else if (const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&observation)) {
        readPoints(*velodyne, scan);
    } else {
        readPoints(dynamic_cast<const CObservationPointCloud&>(observation), scan);
        const TableCloud* const table = tableCloudOf(observation);
        if (table != nullptr && rings != nullptr) *rings = table->rings();
    }
    return true;
}

void readObservation(const mrpt::obs::CObservation& observation, const Settings& settings,
                     ObservedScan& observed, const SharedBeams& beams) {
    observed.remark.clear();
    observed.recovered.reset();
    observed.is_sensor_assumed = false;
    const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&observation);
    if (velodyne != nullptr && !velodyne->scan_packets.empty()) {
        readPackets(*velodyne, settings, observed);
        return;
    }
    if (const auto* rotating = rotatingScanOf(observation)) {
        readRotating(*rotating, settings, beams, observed);
        return;
    }
    if (velodyne != nullptr) {
        readPoints(*velodyne, observed.scan);
        if (velodyne->point_cloud.size() == 0) observed.remark = "the scan has no packets";
    } else if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation)) {
        if (const LocatedCloud* located = locatedCloudOf(observation)) {
            readLocated(*cloud, *located, settings, observed);
            return;
        }
        readPoints(*cloud, observed.scan);
        observed.remark = remarkOnFields(*cloud);
    } else if (const auto* depth = depthScanOf(observation)) {
        readDepthScan(*depth, observed.scan);
    } else {
        throw std::runtime_error("not a LiDAR scan");
    }
    takeCloudSensor(settings, beams, observed);
    locateBeams(observed.sensor, observed.scan);
    if (const TableCloud* const table = tableCloudOf(observation)) {
        observed.scan.time_s = table->times_s();
        if (observed.recovered) {
            takeRings(table->rings(), observed.recovered->row_of_ring, observed.scan);
        }
    }
}

mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, const std::vector<std::uint32_t>& indices,
                                    CloudClass cloud_class) {
    if (cloud_class == CloudClass::Generic) return genericCloudOf(pointsOf(tableOf(scan), indices));
    // Reserve first: appending points one by one costs several times as much.
    const auto fill = [&](auto points, const auto& set_more) {
        checkMemoryFor(indices.size());
        points->setSize(indices.size());
        for (std::size_t k = 0; k < indices.size(); ++k) {
            const std::uint32_t i = indices[k];
            points->setPointFast(k, scan.x_m[i], scan.y_m[i], scan.z_m[i]);
            set_more(*points, k, i);
        }
        points->mark_as_modified();
        return points;
    };
    if (cloud_class == CloudClass::Simple) {
        return fill(PortableCloud::Create(), [](auto&, std::size_t, std::uint32_t) {});
    }
    return fill(std::make_shared<IntensityCloud>(),
                [&](IntensityCloud& points, std::size_t k, std::uint32_t i) {
                    points.setPointIntensity(k, scan.intensity[i]);
                });
}

mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, CloudClass cloud_class) {
    std::vector<std::uint32_t> all(scan.size());
    std::iota(all.begin(), all.end(), 0u);
    return cloudOf(scan, all, cloud_class);
}

CObservationPointCloud::Ptr observationOf(const Scan& scan, const std::string& label,
                                          mrpt::Clock::time_point time, CloudClass cloud_class) {
    auto observation = CObservationPointCloud::Create();
    observation->timestamp = time;
    observation->sensorLabel = label;
    observation->pointcloud = cloudOf(scan, cloud_class);
    return observation;
}

}  // namespace hagen::observations
