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

/// How the messages of a topic hold scans.
enum class LidarKind {
    None,      ///< not at all
    Cloud,     ///< sensor_msgs/PointCloud2
    Velodyne,  ///< velodyne_msgs/VelodyneScan
    Ouster,    ///< PacketMsg of ouster_ros, ouster_msgs and ouster_sensor_msgs
    Livox2,    ///< livox_ros_driver2/CustomMsg
    Livox1     ///< livox_ros_driver/CustomMsg
};
LidarKind lidarKindOf(const BagTopic& topic);

/// A pose as recorded; it takes less memory than MRPT's.
struct RecordedPose {
    std::int64_t time_ns;
    double x_m, y_m, z_m, qw, qx, qy, qz;
};

/// Poses of one frame in another.
struct PoseSeries {
    std::string source;  ///< "nav_msgs/Odometry on /odom", "transforms from odom to base_link"
    std::string parent, child;        ///< frames; child empty: not said
    std::vector<RecordedPose> poses;  ///< at most one per 10 ms, in the order of the bag
};

/// Skipped messages of a topic of poses or frames.
struct LeftOut {
    struct Kind {
        std::size_t number = 0;
        std::string first;  ///< which, and why
    };
    Kind messages;       ///< that could not be read
    Kind transforms;     ///< without a pose, in messages that could be read
    Kind other_parents;  ///< transforms of a frame that had another parent before
    Kind further;        ///< transforms of frames beyond the most that are kept
};

constexpr std::size_t kMaxMovingFrames = 1000;  ///< of tf; of tf_static: FrameTree::kMaxFrames

/// Facts about a bag that are needed before its first scan is read. A static transform, the
/// metadata of a sensor or a pose may come after the scan that needs it.
struct BagSurvey {
    struct Topic {
        BagTopic topic;
        std::size_t messages = 0;
        LidarKind kind = LidarKind::None;
        std::string frame;  ///< of the first message that could be read; of LiDAR topics only
        /// Models in packets of the first messages of a Velodyne, and how many of each.
        std::map<std::uint8_t, std::size_t> velodyne_ids;
        std::size_t velodyne_messages = 0;  ///< that these are of
    };
    std::vector<Topic> topics;  ///< in the order of the bag
    /// By topic: those of nav_msgs/Odometry, then of geometry_msgs/PoseStamped and
    /// PoseWithCovarianceStamped.
    std::map<std::string, PoseSeries> odometry, poses;
    std::map<std::string, PoseSeries> transforms;  ///< of tf, by child frame
    FrameTree frames;                              ///< of tf_static
    struct Imu {
        std::string frame;
        std::size_t orientations = 0;  ///< messages with one
    };
    std::map<std::string, Imu> imus;                     ///< by topic
    std::map<std::string, std::string> ouster_metadata;  ///< by topic
    std::map<std::string, LeftOut> left_out;             ///< by topic
    std::size_t messages = 0;                            ///< read, of all topics
    bool is_whole = true;
    std::string broken_because;  ///< empty: it was read to its end, or ended by the caller
};

/// Reads a bag to its end, to where it breaks off, or until `keep_going` returns false, which is
/// asked while it reads, too (is_whole is then false). Throws BrokenRecording naming the file if it
/// cannot be opened.
BagSurvey surveyBag(
    const std::filesystem::path& file,
    const std::function<bool()>& keep_going = [] { return true; });

/// "/points (sensor_msgs/PointCloud2, 20 messages), ...", at most `most` of them.
std::string textOfTopics(const BagSurvey& survey, std::size_t most = 30);

}  // namespace hagen::recordings
