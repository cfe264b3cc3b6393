#include "recordings/SweepObservation.h"
#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/sensors/VelodynePacket.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/poses/CPose3D.h>
#include "recordings/Remarks.h"

#include <cstring>
#include <utility>

namespace hagen::recordings {
namespace {

mrpt::obs::CObservation::Ptr velodyneScanOf(const sensors::LidarSweep& sweep) {
    auto scan = mrpt::obs::CObservationVelodyneScan::Create();
    scan->originalReceivedTimestamp = timeOf(sweep.time_ns);
    scan->calibration = observations::mrptCalibration(sweep.calibration);
    scan->minRange = static_cast<double>(sweep.sensor->min_range_m);
    scan->maxRange = static_cast<double>(sweep.sensor->max_range_m);
    static_assert(sizeof scan->scan_packets[0] == sensors::kVelodynePacketBytes);
    scan->scan_packets.resize(sweep.packets.size() / sensors::kVelodynePacketBytes);
    std::memcpy(static_cast<void*>(scan->scan_packets.data()), sweep.packets.data(),
                sweep.packets.size());
    return scan;
}

mrpt::obs::CObservation::Ptr cloudOf(const sensors::LidarSweep& sweep) {
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    const Eigen::Vector3d& at_m = sweep.origin_m;
    cloud->sensorPose = mrpt::poses::CPose3D(at_m.x(), at_m.y(), at_m.z(), 0, 0, 0);
    observations::PointTable fields;
    if (sweep.has_tags) {
        fields.points = sweep.returns.size();
        addColumn("tag", observations::NumberType::UInt8, {sweep.tags.begin(), sweep.tags.end()},
                  fields);
    }
    cloud->pointcloud = std::make_shared<observations::LocatedCloud>(sweep.returns, sweep.sensor,
                                                                     std::move(fields));
    return cloud;
}

}  // namespace

mrpt::obs::CObservation::Ptr observationOf(const sensors::LidarSweep& sweep) {
    const auto observation = sweep.packets.empty() ? cloudOf(sweep) : velodyneScanOf(sweep);
    observation->sensorLabel = sweep.label;
    observation->timestamp = timeOf(sweep.time_ns);
    return observation;
}

}  // namespace hagen::recordings
