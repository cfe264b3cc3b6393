#pragma once
#include "recordings/clouds/CloudBytes.h"

namespace hagen::recordings {

/// The header of a PCD, consistent in itself but not checked against the data.
struct PcdHeader {
    enum class Data { Ascii, Binary, Compressed };
    /// All fields in order, including padding (named "_").
    std::vector<observations::PointField> fields;
    std::size_t bytes_per_point = 0;
    std::size_t points = 0;
    Data data = Data::Ascii;
    bool has_viewpoint = false;  ///< whether the sensor is not at the origin
    std::size_t size = 0;
    std::size_t lines = 0;
};

/// Throws BrokenRecording naming file and line.
PcdHeader readPcdHeader(const std::filesystem::path& file, const Bytes& bytes);

}  // namespace hagen::recordings
