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

/// Returns the fields of a message in its topic's serialisation ("ros1" or "cdr"). Throws
/// std::runtime_error for other serialisations. Decompresses individually compressed messages
/// (zstd) into `unpacked`.
FieldReader fieldsOf(const BagMessage& message, const std::string& encoding,
                     std::vector<std::uint8_t>& unpacked);

/// Such as "message 3 (recorded at 1700000000.100 s): ".
std::string nameOf(std::size_t number, std::int64_t recorded_ns);

/// The functions below read messages of these types. They throw TooShort or another
/// std::runtime_error with the reason, and check counts against the number of available bytes.

/// std_msgs/Header. The frame has no leading slash.
struct Header {
    std::int64_t time_ns = 0;  ///< 0 if missing
    std::string frame;
};
Header readHeader(FieldReader& fields);

/// sensor_msgs/PointCloud2 without padding.
struct PointCloud2 {
    Header header;
    observations::PointTable table;
};
PointCloud2 readPointCloud2(FieldReader& fields);
/// Whether the coordinates are plausible, from 0.1 mm to 10 km, only in the other byte order.
bool hasWrongByteOrder(const observations::PointTable& table);

/// velodyne_msgs/VelodyneScan (packets of 1206 bytes) or pandar_msgs/PandarScan (Hesai).
struct PacketsMessage {
    struct Packet {
        std::int64_t time_ns;
        const std::uint8_t* bytes;
        std::size_t size;
    };
    Header header;
    std::vector<Packet> packets;
};
PacketsMessage readVelodyneScan(FieldReader& fields);
PacketsMessage readPandarScan(FieldReader& fields);

/// Reads the packet in a PacketMsg of ouster_ros, ouster_msgs or ouster_sensor_msgs.
ByteView readPacket(FieldReader& fields);

/// CustomMsg of livox_ros_driver2 or livox_ros_driver.
struct LivoxPoint {
    std::uint32_t since_ns;  ///< time since the first point
    float x_m, y_m, z_m;
    std::uint8_t reflectivity, tag, line;
};
struct LivoxMessage {
    Header header;
    std::vector<LivoxPoint> points;
};
LivoxMessage readLivox(FieldReader& fields);

/// A pose with its time and frames, from nav_msgs/Odometry, geometry_msgs/PoseStamped or
/// PoseWithCovarianceStamped, or one transform of tf2_msgs/TFMessage.
struct PoseMessage {
    Header header;
    std::string child;  ///< child frame; empty if unknown
    std::array<double, 3> position_m;
    std::array<double, 4> rotation_wxyz;  ///< as recorded, may not be normalized
    /// Returns nullopt if a number is not finite or the rotation is zero.
    std::optional<mrpt::poses::CPose3D> pose() const;
};
PoseMessage readOdometry(FieldReader& fields);
PoseMessage readPoseStamped(FieldReader& fields);
std::vector<PoseMessage> readTransforms(FieldReader& fields);

/// sensor_msgs/Imu. The orientation is nullopt if it is marked as missing or invalid.
struct ImuMessage {
    Header header;
    std::optional<std::array<double, 4>> rotation_wxyz;
    std::array<double, 3> acceleration_m_s2;
};
ImuMessage readImu(FieldReader& fields);

std::string readString(FieldReader& fields);

}  // namespace hagen::recordings
