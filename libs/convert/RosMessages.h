#pragma once
#include <hagen/mrpt/PointTable.h>
#include <mrpt/poses/CPose3D.h>
#include "filter/RoiBoxes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hagen::convert {

/// A message type of ROS 2.
struct RosType {
    std::string name;        ///< "sensor_msgs/msg/PointCloud2"
    std::string definition;  ///< in ros2msg format: its fields, then the fields of nested types
};

const RosType& pointCloud2Type();
const RosType& markerArrayType();
const RosType& poseStampedType();
const RosType& transformsType();

/// Time and frame. Times are from 1970 to 2038, because ROS 2 has 32-bit seconds.
struct RosHeader {
    std::int64_t time_ns = 0;
    std::string frame;
};

/// The messages below are CDR (little-endian), as defined in ROS 2 Humble and later.

/// sensor_msgs/msg/PointCloud2: a checked little-endian table as a cloud of one row. Throws
/// std::runtime_error for 64-bit integers and for more than 4 GB.
std::vector<std::uint8_t> pointCloud2Message(const RosHeader& header,
                                             const observations::PointTable& table);

/// visualization_msgs/msg/MarkerArray: a marker that deletes all earlier markers, then a cube per
/// box with the component number as id.
std::vector<std::uint8_t> boxesMessage(const RosHeader& header, const std::vector<RoiBox>& boxes);

/// geometry_msgs/msg/PoseStamped: a pose in the frame of the header.
std::vector<std::uint8_t> poseMessage(const RosHeader& header, const mrpt::poses::CPose3D& pose);

/// tf2_msgs/msg/TFMessage with one transform: the pose of `child` in the frame of the header.
std::vector<std::uint8_t> transformMessage(const RosHeader& header, const std::string& child,
                                           const mrpt::poses::CPose3D& pose);

}  // namespace hagen::convert
