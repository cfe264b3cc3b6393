#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/scan/MostReturns.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include "mrpt/DepthCamera.h"
#include "mrpt/PointFields.h"
#include "mrpt/Results.h"
#include "mrpt/TableCloud.h"

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>
#include <utility>

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;

template <class Coordinates>
void assignPoints(const Coordinates& x, const Coordinates& y, const Coordinates& z, Scan& scan) {
    checkReturns(x.size());
    scan.x_m.assign(x.begin(), x.end());
    scan.y_m.assign(y.begin(), y.end());
    scan.z_m.assign(z.begin(), z.end());
    scan.intensity.assign(x.size(), 0.0f);
    scan.time_s.clear();
}

/// Scales intensities to 0..1 if they range from 0 to 255, as with many drivers.
template <class Intensities>
void assignIntensities(const Intensities& intensities, Scan& scan) {
    const auto max = std::max_element(intensities.begin(), intensities.end());
    const float full = max != intensities.end() && *max > 1.0f ? 255.0f : 1.0f;
    scan.intensity.resize(intensities.size());
    std::transform(intensities.begin(), intensities.end(), scan.intensity.begin(),
                   [&](float intensity) { return std::clamp(intensity / full, 0.0f, 1.0f); });
}

bool isSame(const Settings::Sensor& a, const Settings::Sensor& b) {
    return a.model == b.model && a.elevations_deg == b.elevations_deg &&
           a.min_range_m == b.min_range_m && a.max_range_m == b.max_range_m;
}

/// Sets the sensor of a cloud; rebuilds it, which allocates, only if it changed.
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
        throw std::runtime_error("the arrays of the point cloud differ in size");
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

/// Rings and times from the fields of a cloud.
struct FieldsOfReturns {
    PointFieldValues<std::int32_t> rings;
    PointFieldValues<float> times_s;
};

FieldsOfReturns fieldsOfReturns(const CObservationPointCloud& observation) {
    FieldsOfReturns found;
    if (const TableCloud* const table = tableCloudOf(observation)) {
        found.rings.values = table->rings();
        found.times_s.values = table->times_s();
    } else if (const auto fields = otherFieldsOf(*observation.pointcloud)) {
        if (fields->points != observation.pointcloud->size()) return found;
        std::vector<std::uint32_t> all(fields->points);
        std::iota(all.begin(), all.end(), 0u);
        found = {ringsOf(*fields, all), timesOf(*fields, all)};
    }
    return found;
}

/// Lists the unused fields of a newer MRPT's cloud, and warnings about used fields.
std::string remarkOnFields(const CObservationPointCloud& observation, const FieldsOfReturns& used,
                           bool are_rings_used) {
    std::string names;
    for (const std::string& field : fieldsNotKept(*observation.pointcloud)) {
        if (field == used.times_s.field || (are_rings_used && field == used.rings.field)) continue;
        names += (names.empty() ? "" : ", ") + field;
    }
    std::string remark;
    const auto add = [&](const std::string& text) {
        if (!text.empty()) remark += (remark.empty() ? "" : "; ") + text;
    };
    if (!names.empty()) {
        add("the filter ignores these cloud fields; --cloud generic, --clouds and "
            "--mcap keep them: " +
            names);
    }
    add(used.rings.remark);
    add(used.times_s.remark);
    return remark;
}

const LocatedCloud* locatedCloudOf(const mrpt::obs::CObservation& observation) {
    const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation);
    return cloud == nullptr ? nullptr : dynamic_cast<const LocatedCloud*>(cloud->pointcloud.get());
}

/// Sets rows by ring numbers where known.
void takeRings(const std::vector<std::int32_t>& rings, const std::vector<int>& row_of_ring,
               Scan& scan) {
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const auto ring = static_cast<std::size_t>(rings[i]);
        if (ring >= row_of_ring.size() || row_of_ring[ring] < 0) continue;
        scan.row[i] = static_cast<std::uint8_t>(row_of_ring[ring]);
    }
}

/// Applies the settings' range limits, but not their beams, to the sensor from the recording.
void takeOwnSensor(const Settings& settings, ObservedScan& observed) {
    SensorModel& sensor = observed.sensor;
    sensor.min_range_m = settings.sensor.min_range_m.value_or(sensor.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(sensor.max_range_m);
    if (settings.sensor.model && settings.sensor.model != sensor.name) {
        observed.remark = "the recorded sensor is " + sensor.name +
                          "; its beams override the settings' sensor.model " +
                          *settings.sensor.model;
    }
}

/// Reads a cloud with known beams.
void readLocated(const CObservationPointCloud& observation, const LocatedCloud& cloud,
                 const Settings& settings, ObservedScan& observed) {
    observed.sensor = cloud.sensor();
    takeOwnSensor(settings, observed);
    readPoints(observation, observed.scan);
    locateBeams(observed.sensor, observed.scan);
    observed.scan.row = cloud.rows();  // exact even for near returns
    observed.scan.time_s = cloud.times_s();
}

/// Reads a cloud whose beams come from the settings, recovery, or a field.
void readCloud(const CObservationPointCloud& observation, const Settings& settings,
               const SharedBeams& beams, ObservedScan& observed) {
    readPoints(observation, observed.scan);
    takeCloudSensor(settings, beams, observed);
    locateBeams(observed.sensor, observed.scan);
    FieldsOfReturns fields = fieldsOfReturns(observation);
    if (observed.recovered) {
        takeRings(fields.rings.values, observed.recovered->row_of_ring, observed.scan);
    }
    const bool are_rings_used = observed.recovered && !observed.recovered->row_of_ring.empty();
    observed.remark = remarkOnFields(observation, fields, are_rings_used);
    observed.scan.time_s = std::move(fields.times_s.values);
}

void readRotating(const mrpt::obs::CObservationRotatingScan& observation, const Settings& settings,
                  const SharedBeams& beams, ObservedScan& observed) {
    RotatingReturns& returns = observed.work.rotating;
    if (organizedPointsOf(observation) == nullptr) {
        readRangeImage(observation, settings, observed.scan, observed.sensor, returns);
        takeOwnSensor(settings, observed);
    } else {
        readOrganizedPoints(observation, observed.scan, returns);
        takeCloudSensor(settings, beams, observed);
        if (!settings.sensor.model) {
            takeLimits(observation, observed.sensor);
            takeOwnSensor(settings, observed);
        }
        locateBeams(observed.sensor, observed.scan);
        if (observed.recovered) {
            takeRings(returns.image_row, observed.recovered->row_of_ring, observed.scan);
        }
    }
    if (observed.remark.empty()) {
        observed.remark = returns.remark;
    } else if (!returns.remark.empty()) {
        observed.remark += "; " + returns.remark;
    }
}

void readPackets(const CObservationVelodyneScan& observation, const Settings& settings,
                 ObservedScan& observed) {
    sensorOf(observation, observed.sensor, observed.work.decoder);
    takeOwnSensor(settings, observed);
    const std::size_t unsound_blocks =
        decodePackets(observation, observed.scan, observed.work.decoder);
    if (unsound_blocks > 0) {
        observed.remark = std::to_string(unsound_blocks) + " of " +
                          std::to_string(observation.scan_packets.size() * 12) +
                          " packet blocks skipped: invalid header or azimuth";
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
        const auto& cloud = dynamic_cast<const CObservationPointCloud&>(observation);
        readPoints(cloud, scan);
        if (rings != nullptr) *rings = fieldsOfReturns(cloud).rings.values;
    }
    return true;
}

void showCloud(const mrpt::obs::CObservation& observation, CloudSensors& sensors) {
    if (sensors.isSettled(observation.sensorLabel)) return;
    Scan scan;
    std::vector<std::int32_t> rings;
    try {
        if (!readCloudPoints(observation, scan, &rings)) return;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        return;  // readObservation() reports the error
    }
    sensors.see(observation.sensorLabel, scan, rings);
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
        } else {
            readCloud(*cloud, settings, beams, observed);
        }
        return;
    } else if (const auto* depth = depthScanOf(observation)) {
        readDepthScan(*depth, observed.scan);
    } else {
        throw std::runtime_error("not a LiDAR scan");
    }
    takeCloudSensor(settings, beams, observed);
    locateBeams(observed.sensor, observed.scan);
}

mrpt::maps::CPointsMap::Ptr cloudOf(const Scan& scan, const std::vector<std::uint32_t>& indices,
                                    CloudClass cloud_class) {
    if (cloud_class == CloudClass::Generic) return genericCloudOf(pointsOf(tableOf(scan), indices));
    // Reserves memory first, because growing point by point takes several times as long.
    const auto fill = [&](auto points, const auto& set_more) {
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
