#pragma once
#include <hagen/mrpt/PointTable.h>
#include <hagen/recordings/BrokenRecording.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Formats of single-cloud files.
enum class CloudFormat {
    Pcd,  ///< Point Cloud Library, 0.6 and 0.7: ascii, binary, binary_compressed
    Ply,  ///< vertices of a Stanford polygon file: ascii, binary little and big endian
    Las,  ///< ASPRS LAS 1.0 to 1.4, point formats 0 to 10, uncompressed
    Npy,  ///< NumPy array: N x 3 or more floats, or structured with fields
    Bin   ///< float32 x, y, z, intensity (KITTI), and optionally ring (nuScenes); no header
};

/// The names of the float32 numbers of a point in a .bin; "-": skipped. Empty: detected.
using BinFields = std::vector<std::string>;

/// Parses "x,y,z,i,r,t,-": i, r and t stand for intensity, ring and time; other names are kept.
/// Throws std::runtime_error unless there are one x, y and z, and no name occurs twice.
BinFields binFieldsOf(const std::string& text);

/// A cloud as stored in a file.
struct CloudFile {
    observations::PointTable table;  ///< validated, in the byte order of this machine
    /// Remarks for the user on content of the file that is not in the table.
    std::vector<std::string> remarks;
};

/// Detects the format of a file by its content; nullopt if the format is unknown or the file cannot
/// be read. A .bin has no magic number: its size must be a multiple of 16 or 20, and the first 4096
/// bytes must be plausible LiDAR points: within 1 km or not finite, and not all zero. Its points
/// have a ring if every fifth number is an integer up to 255, not all coordinates are integers, and
/// there are at least 16 returns, either from two or more rings in the first 4096 bytes or in the
/// whole file.
std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file);

/// True if a file has the extension of a cloud file: .pcd, .ply, .las, .laz, .npy, .bin.
bool hasCloudName(const std::filesystem::path& file);

/// Reads a cloud file. Detects its format by its content. Allocates at most 256 times the file
/// size. Throws BrokenRecording if the file is invalid or has more than kMaxReturns points.
///
/// - BIN: a file named .bin may also be empty or start with 4096 zero bytes (rows without returns).
///   Its layout is then detected from the bytes that follow the first return. It is rejected if its
///   points are not in scan order with 4 or 5 numbers, but are with 3 to 8. A file named .bin has
///   `bin_fields` if these are given.
/// - PCD: fields named "_" are padding and are omitted.
/// - PLY: elements other than `vertex`, and lists, are omitted and listed in the remarks.
/// - LAS: x, y, z are float64, scaled and shifted by the header; with the fields intensity
///   (uint16), return_number, number_of_returns, classification, user_data, classification_flags
///   (1: synthetic, 2: key-point, 4: withheld, 8: overlap), scan_direction (0, 1),
///   edge_of_flight_line (0, 1) (uint8), scan_angle [degrees] (float32), point_source_id (uint16),
///   and, depending on the point format, scanner_channel (uint8), gps_time (float64), red, green,
///   blue, nir (uint16). Extra bytes and variable length records are listed in the remarks.
/// - NPY: columns of a plain array are x, y, z, intensity, field_4 and so on. Arrays (3, N), (4, N)
///   and (4, H, W) have their channels first if the last size exceeds 32. Fields of a
///   structured array keep their names; fields that are not plain numbers are omitted and listed.
CloudFile readCloud(const std::filesystem::path& file, const BinFields& bin_fields = {});

/// Marks a folder of labelled clouds as an output of this project.
constexpr const char* kCloudsMarker = "made_by.txt";

}  // namespace hagen::recordings
