#pragma once
#include <Eigen/Core>
#include "recordings/bags/BagFile.h"
#include "recordings/bags/FrameTree.h"
#include "sensors/velodyne/AzimuthView.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The kind of LiDAR data in a topic's messages.
enum class LidarKind {
    None,      ///< no LiDAR data
    Cloud,     ///< sensor_msgs/PointCloud2
    Velodyne,  ///< velodyne_msgs/VelodyneScan
    Ouster,    ///< PacketMsg of ouster_ros, ouster_msgs and ouster_sensor_msgs
    Livox2,    ///< livox_ros_driver2/CustomMsg
    Livox1,    ///< CustomMsg of livox_ros_driver and livox_interfaces (older models)
    Hesai      ///< pandar_msgs/PandarScan
};
LidarKind lidarKindOf(const BagTopic& topic);

/// A recorded pose, smaller than MRPT's class.
struct RecordedPose {
    std::int64_t time_ns;
    double x_m, y_m, z_m, qw, qx, qy, qz;
};

/// Poses of one frame relative to another.
struct PoseSeries {
    std::string source;               ///< such as "transforms from odom to base_link"
    std::string parent, child;        ///< frame names; `child` is empty if unknown
    std::vector<RecordedPose> poses;  ///< at most one pose per 10 ms, in bag order
};

/// Skipped messages and transforms of a pose or transform topic.
struct Skipped {
    std::size_t number = 0;
    std::string first;  ///< first skipped message and the reason
};

constexpr std::size_t kMaxMovingFrames = 1000;  ///< for tf; FrameTree::kMaxFrames is for tf_static

/// Information needed before the first scan of a bag is read. Static transforms, sensor metadata
/// and poses may be stored after the scans that need them.
struct BagSurvey {
    struct Topic {
        BagTopic topic;
        std::size_t messages = 0;
        std::int64_t first_ns = 0, last_ns = 0;  ///< recording times of its messages
        LidarKind kind = LidarKind::None;
        std::string frame;  ///< frame of the first readable message; LiDAR topics only
        /// Number of packets per model ID in the first messages of a Velodyne topic.
        std::map<std::uint8_t, std::size_t> velodyne_ids;
        std::size_t velodyne_messages = 0;  ///< number of messages with these packets
        sensors::AzimuthView velodyne_view;
    };
    std::vector<Topic> topics;  ///< in bag order
    /// By topic: nav_msgs/Odometry, and geometry_msgs/PoseStamped or PoseWithCovarianceStamped.
    std::map<std::string, PoseSeries> odometry, poses;
    std::map<std::string, PoseSeries> transforms;  ///< from tf, by child frame
    FrameTree frames;                              ///< from tf_static
    /// Orientations may be stored after the scans that need them.
    struct Imu {
        struct Orientation {
            std::int64_t recorded_ns, time_ns;
            std::array<double, 4> wxyz;
        };
        std::string frame;
        std::vector<Orientation> orientations;                        ///< by recording time
        Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();  ///< sum over the messages
    };
    std::map<std::string, Imu> imus;                     ///< by topic
    std::map<std::string, std::string> ouster_metadata;  ///< by topic
    std::map<std::string, Skipped> skipped;              ///< by topic
    std::size_t messages = 0;                            ///< number of messages read, of all topics
    bool is_out_of_order = false;  ///< whether a LiDAR message has an earlier time than the last
    bool is_whole = true;
    std::string damage;          ///< a damaged chunk
    std::string broken_because;  ///< empty if read to its end or stopped by the caller
};

/// Reads a bag to its end, to an error, or until `keep_going` returns false (even within a message;
/// is_whole is then false). Throws BrokenRecording naming the file if it cannot be opened.
BagSurvey surveyBag(
    const std::filesystem::path& file,
    const std::function<bool()>& keep_going = [] { return true; });

/// Such as "/points (sensor_msgs/PointCloud2, 20 messages), ...", limited to `max` topics.
std::string textOfTopics(const BagSurvey& survey, std::size_t max = 30);

}  // namespace hagen::recordings
