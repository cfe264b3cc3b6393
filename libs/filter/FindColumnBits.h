#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hwy/base.h>
#include <cstdint>
#include <type_traits>
#include <vector>
#include "filter/ColumnBits.h"

namespace hagen {

/// `seam` is a buffer for the image's last columns, followed by the first column.
void findLinks(const Image<float>& image, float max_step, ColumnLinks& links,
               std::vector<float>& seam);
void findPresent(const Image<float>& image, ColumnBits& present, std::vector<float>& seam);
void findLabelled(const Image<Label>& labels, Label label, ColumnBits& labelled,
                  std::vector<std::uint8_t>& seam);

/// Calls visit(n) for each set bit n, lowest first.
template <class Visit>
void forEachBit(std::uint64_t bits, Visit visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
    }
}

/// Calls visit(words) with the number of words per column, as a compile-time constant for the
/// common value.
template <class Visit>
void withWordsOf(int rows, Visit visit) {
    if (rows <= kWordRows) {
        visit(std::integral_constant<int, 1>());
    } else {
        visit(wordsOf(rows));
    }
}

}  // namespace hagen
