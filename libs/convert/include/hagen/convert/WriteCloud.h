#pragma once
#include <hagen/mrpt/PointTable.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hagen::convert {

/// Binary formats that clouds are written in.
enum class OutputFormat { Ply, Pcd };

/// ".ply", ".pcd".
const char* extensionOf(OutputFormat format);

/// Writes a checked table in the byte order of this machine: binary little-endian PLY 1.0, or
/// binary PCD 0.7 with the points in one row. Coordinates come first; they are written as float32,
/// so that every reader takes them, and all other fields in their order and type.
///
/// PLY knows no 64-bit integers and no arrays: these become float64 and several fields,
/// `name_0`, `name_1`. Names lose blanks, which the formats' headers cannot hold.
///
/// Throws std::runtime_error naming the file if it cannot be written, and if there is no x, y or z.
void writeCloud(const std::filesystem::path& file, OutputFormat format,
                const observations::PointTable& table);

/// Changes to a table when it is written, for the user: rounded numbers. Empty without any.
std::vector<std::string> changesWhenWritten(OutputFormat format,
                                            const observations::PointTable& table);

/// A checked table, in the byte order of this machine, as a sensor_msgs/PointCloud2 holds it:
/// coordinates come first, as in writeCloud(), then the other fields, each aligned to its size, as
/// many programs read them through pointers. It knows no 64-bit integers either; these become
/// float64. Throws std::runtime_error if there is no x, y or z.
observations::PointTable tableForPointCloud2(const observations::PointTable& table);
/// Its changes; see changesWhenWritten().
std::vector<std::string> changesInPointCloud2(const observations::PointTable& table);

}  // namespace hagen::convert
