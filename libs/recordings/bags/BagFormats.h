#pragma once
#include "recordings/bags/BagFile.h"

#include <string>

namespace hagen::recordings {

// Readers for the formats of openBag(). File formats are detected by their first 16 bytes.

/// ROS 1 bag, format 2.0 (http://wiki.ros.org/Bags/Format/2.0). The index is only used to detect
/// bags that were not closed.
bool isRos1Bag(const std::string& start);
std::unique_ptr<BagFile> openRos1Bag(const std::filesystem::path& file);

/// MCAP file (https://mcap.dev/spec). Ignores the summary. If CRCs are present, checks the CRC of
/// each chunk before returning its messages, and the CRCs of the data and of the summary at their
/// ends.
bool isMcap(const std::string& start);
std::unique_ptr<BagFile> openMcap(const std::filesystem::path& file);

/// Database of a ROS 2 bag (.db3). fieldsOf() decompresses individually compressed messages (zstd).
bool isSqliteBag(const std::string& start);
std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file);

/// Folder of a ROS 2 bag. Reads the files listed in metadata.yaml in order or, without valid
/// metadata, its .mcap or .db3 files in the order of their numbers.
bool isBagFolder(const std::filesystem::path& folder);
std::unique_ptr<BagFile> openBagFolder(const std::filesystem::path& folder);

/// Converts "sensor_msgs/msg/PointCloud2" to "sensor_msgs/PointCloud2".
std::string typeAsInRos1(std::string type);

}  // namespace hagen::recordings
