#pragma once
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/poses/CPose3D.h>
#include "recordings/bags/BagSurvey.h"
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Selects the topics of a bag.
struct BagOptions {
    std::vector<std::string> topics;  ///< LiDAR topics, with or without leading slash; all if empty
    std::filesystem::path sensor_json;  ///< Ouster metadata file; if empty, from the bag
    /// If set, called with each accepted Ouster packet.
    std::function<void(const std::string& label, const sensors::Datagram&)> packet = nullptr;
    std::size_t first_scan = 0;  ///< damaged chunks before this scan are remarks, later ones errors
};

struct BagSensor {
    LidarKind kind = LidarKind::None;
    std::string label;                ///< sensor label of the topic's scans
    double period_s = 0;              ///< mean time between messages; 0 if unknown
    mrpt::poses::CPose3D on_vehicle;  ///< from the bag's static transforms; identity if unknown
    bool has_its_own_poses = false;   ///< whether BagPlan::poses are used as sensor poses
    bool has_imu = false;             ///< whether the IMU's orientation is the sensor's attitude
    bool is_vehicle = false;          ///< whether its own frame is the moving vehicle frame
    std::shared_ptr<const sensors::OusterSensor> ouster;  ///< set for Ouster packets
    const sensors::VelodyneModel* velodyne = nullptr;     ///< set for Velodyne packets
    sensors::SilentSector silence;                        ///< of a Velodyne
};

struct BagPlan {
    std::map<std::string, BagSensor> sensors;    ///< by topic
    const PoseSeries* poses = nullptr;           ///< vehicle poses; null: no poses
    std::shared_ptr<const PoseSeries> composed;  ///< poses composed of several series; may be null
    std::string imu_topic;                       ///< IMU that provides the attitude; may be empty
    mrpt::poses::CPose3D imu_on_vehicle;
    std::vector<std::string> remarks;  ///< topics that are not read, and why
};

/// Plans what to read; docs/rawlog-segment.md describes the choice of topics, poses and frames.
/// Labels are topics without leading slash, with '_' instead of '/'.
///
/// Constant transforms on the path to the LiDAR are treated as static; they provide poses only if
/// nothing moves. Consecutive moving transforms are composed, as are odometry and the transforms
/// that move the LiDAR relative to its frame. Series with poses more than 0.5 s apart on average
/// are used last.
///
/// The vehicle frame is the child frame of the poses. If they have no child frame, it is base_link
/// or base_footprint or, without poses, the root of a sensor's frame.
///
/// Throws std::runtime_error naming the file if a requested topic is missing or is not a LiDAR
/// topic, if the bag has no LiDAR topic, or if Ouster metadata are missing or invalid. `survey`
/// must outlive the plan.
BagPlan planOf(const std::filesystem::path& file, const BagSurvey& survey,
               const BagOptions& options);

}  // namespace hagen::recordings
