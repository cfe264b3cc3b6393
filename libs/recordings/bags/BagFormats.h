#pragma once
#include "recordings/bags/BagFile.h"

#include <string>

namespace hagen::recordings {

// The formats of bags; see openBag(). Those of files are detected by their first 16 bytes.

/// A bag of ROS 1, format 2.0 (http://wiki.ros.org/Bags/Format/2.0). Its index is not used, except
/// that its presence shows that the bag was closed.
bool isRos1Bag(const std::string& start);
std::unique_ptr<BagFile> openRos1Bag(const std::filesystem::path& file);

/// An MCAP file (https://mcap.dev/spec). Its summary is not used. CRCs are checked if present: of
/// each chunk before its messages are returned, of the data and of the summary at their ends.
bool isMcap(const std::string& start);
std::unique_ptr<BagFile> openMcap(const std::filesystem::path& file);

/// A database of a ROS 2 bag (.db3). Messages that are compressed one by one (zstd) are unpacked by
/// fieldsOf().
bool isSqliteBag(const std::string& start);
std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file);

/// A folder of a ROS 2 bag: the files that metadata.yaml lists, one after the other; without valid
/// metadata, its .mcap or .db3 files in the order of their numbers.
bool isBagFolder(const std::filesystem::path& folder);
std::unique_ptr<BagFile> openBagFolder(const std::filesystem::path& folder);

/// "sensor_msgs/msg/PointCloud2" and "sensor_msgs/PointCloud2" are the same type.
std::string typeAsInRos1(std::string type);

}  // namespace hagen::recordings
