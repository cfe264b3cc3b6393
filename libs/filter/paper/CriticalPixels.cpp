#include <hagen/filter/CriticalPixels.h>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/paper/CriticalPixels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// For adjacent columns whose left (and right) neighbours are all earlier, or all later, in the
/// image. Positive floats order like their bits, and the earlier pixel wins ties, so a neighbour is
/// older if its bits, plus 1 if it is earlier, are greater. Branch-free: the results of 64 pixels
/// are one word.
void FindCriticalIn(int begin, int end, int stride, bool left_is_earlier, bool right_is_earlier,
                    const float* HWY_RESTRICT level, CriticalPixels& critical) {
    const hn::ScalableTag<std::int32_t> d;
    const hn::RebindToFloat<decltype(d)> df;
    using V = hn::Vec<decltype(d)>;
    constexpr int kWord = 64;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const V zero = hn::Zero(d), one = hn::Set(d, 1);
    const V left_earlier = hn::Set(d, left_is_earlier),
            right_earlier = hn::Set(d, right_is_earlier);
    std::int32_t* HWY_RESTRICT ascent = critical.ascent.data();
    std::int32_t* HWY_RESTRICT older_neighbours = critical.older_neighbours.data();
    std::int32_t* maximum = critical.maximum.data() + critical.maxima;
    std::int32_t* saddle = critical.saddle.data() + critical.saddles;

    V index = hn::Iota(d, begin);
    for (int word_begin = begin; word_begin < end; word_begin += kWord) {
        std::uint64_t maxima = 0, saddles = 0;
        for (int i = word_begin; i < word_begin + kWord; i += lanes) {
            const V own = hn::BitCast(d, hn::LoadU(df, level + i));
            V highest = own, up = index;
            const auto isOlder = [&](int offset, V earlier) HWY_ATTR {
                const V bits = hn::BitCast(d, hn::LoadU(df, level + i + offset));
                const V neighbour = hn::Add(bits, earlier);
                const V target = hn::Add(index, hn::Set(d, offset));
                up = hn::IfThenElse(hn::Gt(neighbour, highest), target, up);
                highest = hn::Max(neighbour, highest);
                return hn::VecFromMask(d, hn::Gt(neighbour, own));
            };
            const V above = isOlder(1, zero);
            const V above_right = isOlder(stride + 1, right_earlier);
            const V right = isOlder(stride, right_earlier);
            const V below_right = isOlder(stride - 1, right_earlier);
            const V below = isOlder(-1, one);
            const V below_left = isOlder(-stride - 1, left_earlier);
            const V left = isOlder(-stride, left_earlier);
            const V above_left = isOlder(-stride + 1, left_earlier);
            hn::StoreU(up, d, ascent + i);

            const auto bit = [&](V older, int n)
                                 HWY_ATTR { return hn::And(older, hn::Set(d, 1 << n)); };
            const V right_bits = hn::Or(hn::Or(bit(above, 0), bit(above_right, 1)),
                                        hn::Or(bit(right, 2), bit(below_right, 3)));
            const V left_bits = hn::Or(hn::Or(bit(below, 4), bit(below_left, 5)),
                                       hn::Or(bit(left, 6), bit(above_left, 7)));
            hn::StoreU(hn::Or(right_bits, left_bits), d, older_neighbours + i);

            // Around the pixel, a stretch of older neighbours begins after a younger edge
            // neighbour.
            const auto begins = [&](V side, V corner, V next)
                                    HWY_ATTR { return hn::AndNot(side, hn::Or(corner, next)); };
            const V minus_stretches = hn::Add(
                hn::Add(begins(above, above_right, right), begins(right, below_right, below)),
                hn::Add(begins(below, below_left, left), begins(left, above_left, above)));
            const auto is_there = hn::Gt(own, zero);
            maxima |= BitsOf(d, hn::And(is_there, hn::Eq(highest, own))) << (i - word_begin);
            saddles |= BitsOf(d, hn::And(is_there, hn::Gt(hn::Set(d, -1), minus_stretches)))
                       << (i - word_begin);
            index = hn::Add(index, hn::Set(d, lanes));
        }
        if (end - word_begin < kWord) {
            const std::uint64_t inside = (std::uint64_t{1} << (end - word_begin)) - 1;
            maxima &= inside;
            saddles &= inside;
        }
        maximum = AppendBits(maxima, word_begin, maximum);
        saddle = AppendBits(saddles, word_begin, saddle);
    }
    critical.maxima = static_cast<std::size_t>(maximum - critical.maximum.data());
    critical.saddles = static_cast<std::size_t>(saddle - critical.saddle.data());
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

namespace hagen {
namespace {

HWY_EXPORT(FindCriticalIn);

constexpr int kSlack = 2 * 64;  ///< elements that words and vectors access past the ends

}  // namespace

void frameLevels(const Image<float>& image, FramedLevels& framed) {
    framed.rows = static_cast<int>(image.rows());
    framed.columns = static_cast<int>(image.cols());
    const int stride = framed.stride();
    framed.level.resize(1 + static_cast<std::size_t>(framed.columns + 2) * stride + kSlack);
    float* const level = framed.level.data();
    level[0] = 0.0f;
    const auto frameColumn = [&](int from, int to) {
        const float* const source = image.data() + static_cast<std::ptrdiff_t>(from) * framed.rows;
        float* const target = level + framed.indexOf(0, to);
        for (int row = 0; row < framed.rows; ++row) {
            target[row] = source[row] > 0.0f ? source[row] : 0.0f;
        }
        target[framed.rows] = 0.0f;
    };
    for (int column = 0; column < framed.columns; ++column) frameColumn(column, column);
    if (framed.columns > 1) {
        frameColumn(framed.columns - 1, -1);
        frameColumn(0, framed.columns);
    } else {  // a single column, because a pixel is not its own neighbour
        std::fill_n(level + framed.indexOf(0, -1), stride, 0.0f);
        std::fill_n(level + framed.indexOf(0, framed.columns), stride, 0.0f);
    }
}

std::array<int, kNeighbours> neighbourOffsets(int stride) {
    return {1, stride + 1, stride, stride - 1, -1, -stride - 1, -stride, -stride + 1};
}

void findCriticalPixels(const FramedLevels& framed, CriticalPixels& critical) {
    for (auto* list :
         {&critical.ascent, &critical.maximum, &critical.saddle, &critical.older_neighbours}) {
        if (list->size() < framed.level.size()) list->resize(framed.level.size());
    }
    critical.maxima = critical.saddles = 0;
    const auto findIn = [&](int from, int to, bool left_is_earlier, bool right_is_earlier) {
        HWY_DYNAMIC_DISPATCH(FindCriticalIn)
        (framed.indexOf(0, from), framed.indexOf(0, to), framed.stride(), left_is_earlier,
         right_is_earlier, framed.level.data(), critical);
    };
    const int last = framed.columns - 1;
    if (last < 0) return;
    findIn(0, std::min(1, last), false, false);  // the last column is to the left of the first
    findIn(std::min(1, last), last, true, false);
    findIn(last, last + 1, true, true);
    for (int row = 0; row < framed.rows; ++row) {  // links frame pixels to the copied pixels
        critical.ascent[framed.indexOf(row, -1)] = framed.indexOf(row, last);
        critical.ascent[framed.indexOf(row, framed.columns)] = framed.indexOf(row, 0);
    }
}

}  // namespace hagen
#endif
