#pragma once
#include <cstdint>
#include <vector>

namespace hagen {

/// One bit per pixel; each column starts a new word. Row 0 is the lowest bit of a column's first
/// word; bits above the last row are 0. Columns are processed as a whole.
using ColumnBits = std::vector<std::uint64_t>;

constexpr int kWordRows = 64;
inline int wordsOf(int rows) { return (rows + kWordRows - 1) / kWordRows; }

/// The pixels of an image that have a value, and those linked to the pixel above or to the right
/// (azimuth wrapped) because their values differ by less than a given step.
struct ColumnLinks {
    ColumnBits present, above, right;
};

}  // namespace hagen
