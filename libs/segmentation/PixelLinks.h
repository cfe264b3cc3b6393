#pragma once
#include <hagen/range_image/Image.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// The pixels of an image that have a value, and those linked with the pixel above or on the right
/// (azimuth wrapped) because their values differ by less than some step: a bit a pixel, in the
/// order of the image's pixels, with an empty one more on top of each column.
struct PixelLinks {
    int rows = 0, columns = 0;
    /// The image, framed by the empty pixels; after the last column comes the first again. What
    /// fills it calls frame() first.
    std::vector<float> value;
    std::vector<std::uint64_t> present, above, right;  ///< words of 64 pixels
    /// Of the links to the right those that do not follow from the one of the pixel below.
    std::vector<std::uint64_t> first_right;

    static constexpr int kWord = 64;
    int stride() const { return rows + 1; }
    int pixels() const { return columns * stride(); }
    int words() const { return (pixels() + kWord - 1) / kWord; }
};

/// Links the pixels of an image of which `valueOf(pixel)` is the value, NaN where empty.
template <class ValueOf>
void linkPixels(int rows, int columns, ValueOf valueOf, float max_step, PixelLinks& links);

/// The bits, from the values.
void findLinks(float max_step, PixelLinks& links);

template <class ValueOf>
void linkPixels(int rows, int columns, ValueOf valueOf, float max_step, PixelLinks& links) {
    constexpr int kSlack = 2 * PixelLinks::kWord;  // wide vectors read past the end
    links.rows = rows;
    links.columns = columns;
    links.value.resize(static_cast<std::size_t>(links.pixels() + links.stride() + kSlack));
    float* target = links.value.data();
    for (int column = 0; column < columns; ++column, target += links.stride()) {
        for (int row = 0; row < rows; ++row) target[row] = valueOf(column * rows + row);
        target[rows] = kNoValue;
    }
    for (int row = 0; row <= rows; ++row) target[row] = links.value[row];
    findLinks(max_step, links);
}

}  // namespace hagen
