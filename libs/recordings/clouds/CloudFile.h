#pragma once
#include <hagen/mrpt/PointTable.h>
#include <hagen/recordings/BrokenRecording.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Formats of files with one cloud each.
enum class CloudFormat {
    Pcd,  ///< Point Cloud Library, 0.6 and 0.7: ascii, binary, binary_compressed
    Ply,  ///< Stanford polygon file: ascii, binary little and big endian; its vertices
    Las,  ///< ASPRS LAS 1.0 to 1.4, point formats 0 to 10, not compressed
    Npy,  ///< NumPy array: N x 3 or more floats, or a structured one with fields
    Bin   ///< float32 x, y, z, intensity (KITTI), or also ring (nuScenes); no header
};

/// A cloud as a file holds it.
struct CloudFile {
    observations::PointTable table;  ///< checked, in the byte order of this machine
    /// The sensor's position and orientation (w, x, y, z) of a PCD, if it is another than the
    /// origin.
    std::string viewpoint;
    /// What is in the file but not in the table, for the user.
    std::vector<std::string> remarks;
};

/// The format of a file by its content; none if it is of another format or cannot be read. A .bin
/// has no magic: its size is a multiple of 16 or 20, and the first 4096 bytes are points that a
/// LiDAR can see: within 1 km or not finite, and not all zero. Its points have a ring if every
/// fifth number is an integer up to 255, not all coordinates are integers, and there are at least
/// 16 returns: in the first 4096 bytes, of two rings or more, or else in the whole file.
std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file);

/// Whether a name ends like those of cloud files: .pcd, .ply, .las, .laz, .npy, .bin.
bool hasCloudName(const std::filesystem::path& file);

/// Reads a cloud file; its format is detected by its content. Nothing larger than the file, as
/// unpacked by a factor of 256 at most, is ever allocated. Throws BrokenRecording, also for more
/// points than a scan may have (kMaxReturns).
///
/// - BIN: by its name also one without points, or whose first 4096 bytes are zero: rows without
///   returns. The bytes from the first return on then show the layout of its points.
/// - PCD: fields named "_" are padding and left out.
/// - PLY: elements other than `vertex`, and lists, are left out and named in the remarks.
/// - LAS: x, y, z are float64, as scaled and moved by the header; with the fields intensity
///   (uint16), return_number, number_of_returns, classification, user_data, classification_flags
///   (1: synthetic, 2: key-point, 4: withheld, 8: overlap), scan_direction (0, 1),
///   edge_of_flight_line (0, 1) (uint8), scan_angle [degrees] (float32), point_source_id (uint16),
///   and as the point format has them scanner_channel (uint8), gps_time (float64), red, green,
///   blue, nir (uint16). Extra bytes and variable length records are named in the remarks.
/// - NPY: columns of a plain array are x, y, z, intensity, and field_4 and so on. Fields of a
///   structured array keep their names; those that are not plain numbers are left out and named.
CloudFile readCloud(const std::filesystem::path& file);

/// Marks a folder of labelled clouds as an output of this project.
constexpr const char* kCloudsMarker = "made_by.txt";

}  // namespace hagen::recordings
