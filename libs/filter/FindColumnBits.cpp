#include "filter/FindColumnBits.h"

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/FindColumnBits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A word whose lowest `bits` bits are set.
HWY_INLINE std::uint64_t Lowest(int bits) { return ~std::uint64_t{0} >> (kWordRows - bits); }

void FindLinks(const float* HWY_RESTRICT image, int rows, int columns, float max_step,
               std::uint64_t* HWY_RESTRICT present, std::uint64_t* HWY_RESTRICT above,
               std::uint64_t* HWY_RESTRICT right) {
    const hn::ScalableTag<float> d;
    const int lanes = static_cast<int>(hn::Lanes(d)), words = wordsOf(rows);
    const auto step = hn::Set(d, max_step);
    for (int first_row = 0; first_row < rows; first_row += kWordRows) {
        const int inside = std::min(rows - first_row, kWordRows);
        const std::uint64_t mask = Lowest(inside);
        const std::uint64_t below_top = first_row + inside < rows ? mask : mask >> 1;
        const float* HWY_RESTRICT first = image + first_row;
        for (int word = first_row / kWordRows; word < columns * words; word += words) {
            std::uint64_t is_present = 0, is_above = 0, is_right = 0;
            for (int n = 0; n < inside; n += lanes) {
                const auto own = hn::LoadU(d, first + n);
                const auto isLinked = [&](int offset) HWY_ATTR {  // false if either is NaN
                    const auto other = hn::LoadU(d, first + n + offset);
                    return BitsOf(d, hn::Lt(hn::Abs(hn::Sub(other, own)), step)) << n;
                };
                is_present |= BitsOf(d, hn::Eq(own, own)) << n;
                is_above |= isLinked(1);
                is_right |= isLinked(rows);
            }
            present[word] = is_present & mask;
            above[word] = is_above & below_top;
            right[word] = is_right & mask;
            first += rows;
        }
    }
}

/// Finds the pixels for which `isSet` holds.
template <class D, class IsSet>
HWY_INLINE void FindPixels(D d, const hn::TFromD<D>* HWY_RESTRICT image, int rows, int columns,
                           IsSet isSet, std::uint64_t* HWY_RESTRICT bits) {
    const int lanes = static_cast<int>(hn::Lanes(d)), words = wordsOf(rows);
    for (int first_row = 0; first_row < rows; first_row += kWordRows) {
        const int inside = std::min(rows - first_row, kWordRows);
        const hn::TFromD<D>* HWY_RESTRICT first = image + first_row;
        for (int word = first_row / kWordRows; word < columns * words; word += words) {
            std::uint64_t set = 0;
            for (int n = 0; n < inside; n += lanes) {
                set |= BitsOf(d, isSet(hn::LoadU(d, first + n))) << n;
            }
            bits[word] = set & Lowest(inside);
            first += rows;
        }
    }
}

void FindPresent(const float* HWY_RESTRICT image, int rows, int columns,
                 std::uint64_t* HWY_RESTRICT bits) {
    const hn::ScalableTag<float> d;
    FindPixels(
        d, image, rows, columns, [](auto v) HWY_ATTR { return hn::Eq(v, v); }, bits);
}

void FindLabelled(const std::uint8_t* HWY_RESTRICT labels, int rows, int columns,
                  std::uint8_t label, std::uint64_t* HWY_RESTRICT bits) {
    const hn::ScalableTag<std::uint8_t> d;
    const auto sought = hn::Set(d, label);
    FindPixels(
        d, labels, rows, columns, [&](auto v) HWY_ATTR { return hn::Eq(v, sought); }, bits);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(FindLinks);
HWY_EXPORT(FindPresent);
HWY_EXPORT(FindLabelled);

/// Calls find(first pixel, columns, first word) for parts of an image. Vectors read past the end of
/// a column, so the last columns are copied to `seam`, followed by the first column.
template <class T, class Find>
void findInParts(const T* image, int rows, int columns, std::vector<T>& seam, Find find) {
    constexpr int kPast = kWordRows;  // maximum lanes of a vector
    if (rows == 0) return;
    const int last = std::min(columns, 2 + (kPast + rows - 1) / rows), rest = columns - last;
    const T* const first_of_last = image + static_cast<std::ptrdiff_t>(rest) * rows;
    seam.resize(static_cast<std::size_t>((last + 2) * rows + kPast));
    std::copy_n(first_of_last, last * rows, seam.data());
    std::copy_n(image, columns > 0 ? rows : 0, seam.data() + last * rows);
    find(image, rest, 0);
    find(seam.data(), last, static_cast<std::size_t>(rest) * wordsOf(rows));
}

template <class T>
std::size_t wordsOfAll(const Image<T>& image) {
    return static_cast<std::size_t>(image.cols()) * wordsOf(static_cast<int>(image.rows()));
}

}  // namespace

void findLinks(const Image<float>& image, float max_step, ColumnLinks& links,
               std::vector<float>& seam) {
    const int rows = static_cast<int>(image.rows()), columns = static_cast<int>(image.cols());
    for (ColumnBits* bits : {&links.present, &links.above, &links.right}) {
        bits->resize(wordsOfAll(image));
    }
    findInParts(image.data(), rows, columns, seam,
                [&](const float* first, int part, std::size_t word) {
                    HWY_DYNAMIC_DISPATCH(FindLinks)
                    (first, rows, part, max_step, links.present.data() + word,
                     links.above.data() + word, links.right.data() + word);
                });
}

void findPresent(const Image<float>& image, ColumnBits& present, std::vector<float>& seam) {
    const int rows = static_cast<int>(image.rows()), columns = static_cast<int>(image.cols());
    present.resize(wordsOfAll(image));
    findInParts(image.data(), rows, columns, seam,
                [&](const float* first, int part, std::size_t word) {
                    HWY_DYNAMIC_DISPATCH(FindPresent)(first, rows, part, present.data() + word);
                });
}

void findLabelled(const Image<Label>& labels, Label label, ColumnBits& labelled,
                  std::vector<std::uint8_t>& seam) {
    const int rows = static_cast<int>(labels.rows()), columns = static_cast<int>(labels.cols());
    labelled.resize(wordsOfAll(labels));
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(labels.data());
    findInParts(bytes, rows, columns, seam,
                [&](const std::uint8_t* first, int part, std::size_t word) {
                    HWY_DYNAMIC_DISPATCH(FindLabelled)
                    (first, rows, part, static_cast<std::uint8_t>(label), labelled.data() + word);
                });
}

}  // namespace hagen
#endif
