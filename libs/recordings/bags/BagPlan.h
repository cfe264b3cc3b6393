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
    std::vector<std::string> topics;    ///< of LiDARs, with or without leading slash; empty: all
    std::filesystem::path sensor_json;  ///< metadata of its Ouster; empty: those of the bag
};

/// A LiDAR topic to read.
struct BagSensor {
    LidarKind kind = LidarKind::None;
    std::string label;                ///< sensor label of its scans
    mrpt::poses::CPose3D on_vehicle;  ///< by the bag's static transforms; origin: not known
    bool has_its_own_poses = false;   ///< BagPlan::poses are taken for those of the sensor
    bool is_vehicle = false;          ///< its own frame is that of the vehicle, which moves
    std::shared_ptr<const sensors::OusterSensor> ouster;  ///< of Ouster packets; otherwise null
    const sensors::VelodyneModel* velodyne = nullptr;     ///< of a Velodyne's packets
};

/// What is read of a bag.
struct BagPlan {
    std::map<std::string, BagSensor> sensors;  ///< by topic
    const PoseSeries* poses = nullptr;  ///< of the vehicle, in the survey or `composed`; null: none
    std::shared_ptr<const PoseSeries> composed;  ///< of several series; null: poses are not
    std::string imu_topic;                       ///< for the attitude; empty: none
    mrpt::poses::CPose3D imu_on_vehicle;
    std::vector<std::string> remarks;  ///< what is not read, and why
};

constexpr std::size_t kMaxLidarTopics = 100;  ///< read without being named

/// Plans what to read.
///
/// Without BagOptions::topics, it is every LiDAR topic, but of a sensor that sent both packets and
/// clouds only the packets, and no clouds in a frame that does not move with the vehicle. Labels
/// are the topics without leading slash, and with '_' for '/'.
///
/// Poses are those of the odometry topic with the most; without one, of the pose topic with the
/// most; without one, of the transforms that move the frame on which the LiDAR hangs. Transforms
/// on the way there that never change count as static; they are the poses only if nothing moves.
/// Several that move one after the other are composed, up to a frame that does not move (map, odom,
/// world, earth, or without a parent); so are odometry and the transforms that move the LiDAR
/// against its frame. Series with poses farther apart than half a second on average come last.
///
/// The vehicle's frame is the child frame of the poses. If they name none, it is base_link or
/// base_footprint, and without poses also the frame on which a sensor hangs in the end. Poses are
/// taken for those of a sensor that has no place in that frame, with a remark.
///
/// Throws std::runtime_error naming the file if a requested topic is missing or is not a LiDAR's,
/// if the bag has no LiDAR topic, if it has more than kMaxLidarTopics and none is requested, or if
/// the metadata of an Ouster are missing or wrong. `survey` must outlive the plan.
BagPlan planOf(const std::filesystem::path& file, const BagSurvey& survey,
               const BagOptions& options);

}  // namespace hagen::recordings
