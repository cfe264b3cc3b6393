#pragma once
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/poses/CPose3D.h>
#include "recordings/bags/BagSurvey.h"
#include "sensors/ouster/OusterSensor.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Selects the topics of a bag.
struct BagOptions {
    std::vector<std::string> topics;    ///< LiDAR topics, with or without leading slash; empty: all
    std::filesystem::path sensor_json;  ///< Ouster metadata; empty: from the bag
};

/// A LiDAR topic to read.
struct BagSensor {
    LidarKind kind = LidarKind::None;
    std::string label;                ///< sensor label of its scans
    mrpt::poses::CPose3D on_vehicle;  ///< from the bag's static transforms; origin: unknown
    bool has_its_own_poses = false;   ///< BagPlan::poses are used as sensor poses
    bool is_vehicle = false;          ///< its own frame is the moving vehicle frame
    std::shared_ptr<const sensors::OusterSensor> ouster;  ///< for Ouster packets; otherwise null
    const sensors::VelodyneModel* velodyne = nullptr;     ///< for Velodyne packets; otherwise null
};

/// What to read from a bag.
struct BagPlan {
    std::map<std::string, BagSensor> sensors;  ///< by topic
    const PoseSeries* poses = nullptr;  ///< vehicle poses, in the survey or `composed`; null: none
    std::shared_ptr<const PoseSeries> composed;  ///< from several series; null: not composed
    std::string imu_topic;                       ///< for the attitude; empty: none
    mrpt::poses::CPose3D imu_on_vehicle;
    std::vector<std::string> remarks;  ///< topics that are not read, and why
};

constexpr std::size_t kMaxLidarTopics = 100;  ///< limit without BagOptions::topics

/// Plans what to read.
///
/// Without BagOptions::topics, reads every LiDAR topic, except clouds of a sensor that also sent
/// packets, and clouds in a frame that does not move with the vehicle. Labels are the topics
/// without leading slash, with '_' for '/'.
///
/// Poses come from the odometry topic with the most poses, else from the pose topic with the most
/// poses, else from the transforms that move the frame to which the LiDAR is attached. Constant
/// transforms on that path count as static; they are used as poses only if nothing moves.
/// Consecutive moving transforms are composed, up to a world frame (map, odom, world, earth, or
/// without a parent); so are odometry and the transforms that move the LiDAR relative to its frame.
/// Series with poses more than 0.5 s apart on average come last.
///
/// The vehicle frame is the child frame of the poses. If they name no child, it is base_link or
/// base_footprint, or, without poses, the root of a sensor's frame. For a sensor without a
/// transform to that frame, the poses are used as sensor poses, with a remark.
///
/// Throws std::runtime_error naming the file if a requested topic is missing or is not a LiDAR
/// topic, if the bag has no LiDAR topic, if it has more than kMaxLidarTopics and none is requested,
/// or if Ouster metadata are missing or invalid. `survey` must outlive the plan.
BagPlan planOf(const std::filesystem::path& file, const BagSurvey& survey,
               const BagOptions& options);

}  // namespace hagen::recordings
