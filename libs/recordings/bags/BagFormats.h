#pragma once
#include "recordings/bags/BagFile.h"

#include <string>

namespace hagen::recordings {

// The formats of bags; see openBag(). File formats are detected by their first 16 bytes.

/// A ROS 1 bag, format 2.0 (http://wiki.ros.org/Bags/Format/2.0). The index is only used to detect
/// bags that were not closed.
bool isRos1Bag(const std::string& start);
std::unique_ptr<BagFile> openRos1Bag(const std::filesystem::path& file);

/// An MCAP file (https://mcap.dev/spec). Its summary is not used. Checks CRCs if present: of each
/// chunk before returning its messages, and of the data and the summary at their ends.
bool isMcap(const std::string& start);
std::unique_ptr<BagFile> openMcap(const std::filesystem::path& file);

/// A database of a ROS 2 bag (.db3). fieldsOf() decompresses individually compressed messages
/// (zstd).
bool isSqliteBag(const std::string& start);
std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file);

/// A folder of a ROS 2 bag: reads the files listed in metadata.yaml in order, or, without valid
/// metadata, its .mcap or .db3 files in the order of their numbers.
bool isBagFolder(const std::filesystem::path& folder);
std::unique_ptr<BagFile> openBagFolder(const std::filesystem::path& folder);

/// "sensor_msgs/msg/PointCloud2" and "sensor_msgs/PointCloud2" are the same type.
std::string typeAsInRos1(std::string type);

}  // namespace hagen::recordings
