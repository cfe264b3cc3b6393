#pragma once
#include <hagen/mrpt/PointTable.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hagen::convert {

/// Binary output formats of clouds.
enum class OutputFormat { Ply, Pcd };

/// The file extension: ".ply" or ".pcd".
const char* extensionOf(OutputFormat format);

/// Writes a checked table in native byte order as binary little-endian PLY 1.0, or binary PCD 0.7
/// with the points in one row. Coordinates come first, as float32, for compatibility with all
/// readers; other fields keep their order and type.
///
/// PLY has neither 64-bit integers nor arrays, so 64-bit integers become float64 and an array
/// becomes fields `name_0`, `name_1`. Blanks in names, which headers do not support, become '_'.
///
/// Throws std::runtime_error naming the file if it cannot be written, and if x, y or z is missing.
void writeCloud(const std::filesystem::path& file, OutputFormat format,
                const observations::PointTable& table);

/// Messages for the user about numbers that are rounded when a table is written. Empty if there are
/// none.
std::vector<std::string> changesWhenWritten(OutputFormat format,
                                            const observations::PointTable& table);

/// Converts a checked table, in native byte order, to the layout of sensor_msgs/PointCloud2:
/// coordinates first, as in writeCloud(), then the other fields, aligned to their size, because
/// many programs read them through pointers. 64-bit integers, which PointCloud2 does not support,
/// become float64. Throws std::runtime_error if x, y or z is missing.
observations::PointTable tableForPointCloud2(const observations::PointTable& table);
/// Like changesWhenWritten(), but for tableForPointCloud2().
std::vector<std::string> changesInPointCloud2(const observations::PointTable& table);

}  // namespace hagen::convert
