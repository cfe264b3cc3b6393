#pragma once
#include <cstdint>
#include <vector>

namespace hagen {

/// One bit per pixel, in words of their own for each column: row 0 is the lowest bit of a column's
/// first word; bits above the last row are 0. A property of pixels is so found, and used, for a
/// whole column at once.
using ColumnBits = std::vector<std::uint64_t>;

constexpr int kWordRows = 64;
inline int wordsOf(int rows) { return (rows + kWordRows - 1) / kWordRows; }

/// The pixels of an image that have a value, and those linked with the pixel above or on the right
/// (azimuth wrapped) because their values differ by less than some step.
struct ColumnLinks {
    ColumnBits present, above, right;
};

}  // namespace hagen
