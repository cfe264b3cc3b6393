#pragma once
#include "recordings/bags/BagFile.h"
#include "recordings/bags/FrameTree.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The kind of scans in the messages of a topic.
enum class LidarKind {
    None,      ///< no scans
    Cloud,     ///< sensor_msgs/PointCloud2
    Velodyne,  ///< velodyne_msgs/VelodyneScan
    Ouster,    ///< PacketMsg of ouster_ros, ouster_msgs and ouster_sensor_msgs
    Livox2,    ///< livox_ros_driver2/CustomMsg
    Livox1     ///< livox_ros_driver/CustomMsg
};
LidarKind lidarKindOf(const BagTopic& topic);

/// A recorded pose, smaller than MRPT's.
struct RecordedPose {
    std::int64_t time_ns;
    double x_m, y_m, z_m, qw, qx, qy, qz;
};

/// Poses of one frame in another.
struct PoseSeries {
    std::string source;  ///< "nav_msgs/Odometry on /odom", "transforms from odom to base_link"
    std::string parent, child;        ///< frames; child empty: unknown
    std::vector<RecordedPose> poses;  ///< at most one per 10 ms, in bag order
};

/// Skipped messages of a pose or transform topic.
struct LeftOut {
    struct Kind {
        std::size_t number = 0;
        std::string first;  ///< message and reason
    };
    Kind messages;       ///< unreadable messages
    Kind transforms;     ///< without a valid pose, in readable messages
    Kind other_parents;  ///< transforms of a frame that previously had another parent
    Kind further;        ///< transforms of frames beyond the limits
};

constexpr std::size_t kMaxMovingFrames = 1000;  ///< for tf; for tf_static: FrameTree::kMaxFrames

/// Facts about a bag that are needed before its first scan is read. Static transforms, sensor
/// metadata and poses may come after the scans that need them.
struct BagSurvey {
    struct Topic {
        BagTopic topic;
        std::size_t messages = 0;
        LidarKind kind = LidarKind::None;
        std::string frame;  ///< of the first readable message; LiDAR topics only
        /// Packets per model id in the first messages of a Velodyne.
        std::map<std::uint8_t, std::size_t> velodyne_ids;
        std::size_t velodyne_messages = 0;  ///< messages with these packets
    };
    std::vector<Topic> topics;  ///< in bag order
    /// By topic: nav_msgs/Odometry, then geometry_msgs/PoseStamped and PoseWithCovarianceStamped.
    std::map<std::string, PoseSeries> odometry, poses;
    std::map<std::string, PoseSeries> transforms;  ///< from tf, by child frame
    FrameTree frames;                              ///< from tf_static
    struct Imu {
        std::string frame;
        std::size_t orientations = 0;  ///< messages with an orientation
    };
    std::map<std::string, Imu> imus;                     ///< by topic
    std::map<std::string, std::string> ouster_metadata;  ///< by topic
    std::map<std::string, LeftOut> left_out;             ///< by topic
    std::size_t messages = 0;                            ///< messages read, of all topics
    bool is_whole = true;
    std::string broken_because;  ///< empty: read to its end, or stopped by the caller
};

/// Reads a bag to its end, to an error, or until `keep_going` returns false, also within a message
/// (is_whole is then false). Throws BrokenRecording naming the file if it cannot be opened.
BagSurvey surveyBag(
    const std::filesystem::path& file,
    const std::function<bool()>& keep_going = [] { return true; });

/// "/points (sensor_msgs/PointCloud2, 20 messages), ...", at most `most` of them.
std::string textOfTopics(const BagSurvey& survey, std::size_t max = 30);

}  // namespace hagen::recordings
