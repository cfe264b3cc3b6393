#pragma once
#include <hagen/mrpt/PointTable.h>
#include <mrpt/poses/CPose3D.h>
#include "recordings/bags/BagFile.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "recordings/bags/FieldReader.h"

namespace hagen::recordings {

/// The fields of a message in the serialisation that its topic names ("ros1" or "cdr"). Throws
/// std::runtime_error if that is another one. A message that was packed by itself (zstd) is
/// unpacked into `unpacked`.
FieldReader fieldsOf(const BagMessage& message, const std::string& encoding,
                     std::vector<std::uint8_t>& unpacked);

/// "message 3 (recorded at 1700000000.100 s): ".
std::string nameOf(std::size_t number, std::int64_t recorded_ns);

/// The readers below read the messages of that name from their first field on. All throw TooShort
/// or another std::runtime_error that says what is wrong; counts are checked against the bytes that
/// are there.

/// std_msgs/Header. The frame is without a leading slash.
struct Header {
    std::int64_t time_ns = 0;  ///< 0: none
    std::string frame;
};
Header readHeader(FieldReader& fields);

/// sensor_msgs/PointCloud2. Rows that have padding are joined.
struct PointCloud2 {
    Header header;
    observations::PointTable table;
};
PointCloud2 readPointCloud2(FieldReader& fields);

/// velodyne_msgs/VelodyneScan.
struct VelodyneScanMessage {
    struct Packet {
        std::int64_t time_ns;
        const std::uint8_t* bytes;  ///< 1206, those of the message
    };
    Header header;
    std::vector<Packet> packets;
};
VelodyneScanMessage readVelodyneScan(FieldReader& fields);

/// PacketMsg of ouster_ros, ouster_msgs or ouster_sensor_msgs: the packet.
ByteView readPacket(FieldReader& fields);

/// livox_ros_driver2/CustomMsg, and that of livox_ros_driver.
struct LivoxPoint {
    std::uint32_t since_ns;  ///< since the first point
    float x_m, y_m, z_m;
    std::uint8_t reflectivity, tag, line;
};
struct LivoxMessage {
    Header header;
    std::vector<LivoxPoint> points;
};
LivoxMessage readLivox(FieldReader& fields);

/// A pose with its time and frames, from nav_msgs/Odometry, geometry_msgs/PoseStamped,
/// geometry_msgs/PoseWithCovarianceStamped, or one transform of tf2_msgs/TFMessage.
struct PoseMessage {
    Header header;      ///< its frame is that in which the pose is
    std::string child;  ///< frame that the pose is of; empty: not said
    std::array<double, 3> position_m;
    std::array<double, 4> rotation_wxyz;  ///< as it is, perhaps not of length 1
    /// None if it has numbers that are not finite, or no rotation.
    std::optional<mrpt::poses::CPose3D> pose() const;
};
PoseMessage readOdometry(FieldReader& fields);
PoseMessage readPoseStamped(FieldReader& fields);
std::vector<PoseMessage> readTransforms(FieldReader& fields);

/// sensor_msgs/Imu: the orientation; none if the message says that it has none.
struct ImuMessage {
    Header header;
    std::optional<std::array<double, 4>> rotation_wxyz;
};
ImuMessage readImu(FieldReader& fields);

/// std_msgs/String.
std::string readString(FieldReader& fields);

}  // namespace hagen::recordings
