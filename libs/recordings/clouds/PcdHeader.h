#pragma once
#include "recordings/clouds/CloudBytes.h"

namespace hagen::recordings {

/// The header of a PCD, checked for consistency but not against the data.
struct PcdHeader {
    enum class Data { Ascii, Binary, Compressed };
    /// All fields, including those named "_", in order.
    std::vector<observations::PointField> fields;
    std::size_t bytes_per_point = 0;
    std::size_t points = 0;
    Data data = Data::Ascii;
    std::string viewpoint;  ///< empty if at the origin
    std::size_t size = 0;   ///< bytes of the header
    std::size_t lines = 0;  ///< lines of the header
};

/// Throws BrokenRecording naming file and line.
PcdHeader readPcdHeader(const std::filesystem::path& file, const Bytes& bytes);

}  // namespace hagen::recordings
