#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hwy/base.h>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace hagen {

/// A bit a pixel, in words of their own for each column: row 0 is the lowest bit of the first, and
/// above the last row there are none. What holds of a pixel is so found, and said, for all of a
/// column at once.
using ColumnBits = std::vector<std::uint64_t>;

constexpr int kWordRows = 64;
inline int wordsOf(int rows) { return (rows + kWordRows - 1) / kWordRows; }

/// The pixels of an image that have a value, and those linked with the pixel above or on the right
/// (azimuth wrapped) because their values differ by less than some step.
struct ColumnLinks {
    ColumnBits present, above, right;
};

void findLinks(const Image<float>& image, float max_step, ColumnLinks& links);
void findPresent(const Image<float>& image, ColumnBits& present);
void findLabelled(const Image<Label>& labels, Label label, ColumnBits& labelled);

/// Calls visit(n) for each bit n that is set, from the lowest on.
template <class Visit>
void forEachBit(std::uint64_t bits, Visit visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
    }
}

/// Calls visit(words) with the count of words of a column, as a constant where it is the usual one.
template <class Visit>
void withWordsOf(int rows, Visit visit) {
    if (rows <= kWordRows) {
        visit(std::integral_constant<int, 1>());
    } else {
        visit(wordsOf(rows));
    }
}

}  // namespace hagen
