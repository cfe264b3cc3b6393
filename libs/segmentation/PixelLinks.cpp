#include "PixelLinks.h"

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PixelLinks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void FindLinks(float max_step, PixelLinks& links) {
    const hn::ScalableTag<float> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto step = hn::Set(d, max_step);
    const float* HWY_RESTRICT value = links.value.data();
    const int stride = links.stride(), pixels = links.pixels();
    std::uint64_t same_below = 0;
    for (int word = 0; word < links.words(); ++word) {
        const int first = word * PixelLinks::kWord;
        std::uint64_t present = 0, above = 0, right = 0, right_above = 0;
        for (int n = 0; n < PixelLinks::kWord; n += lanes) {
            const float* HWY_RESTRICT pixel = value + first + n;
            const auto own = hn::LoadU(d, pixel);
            const auto on_right = hn::LoadU(d, pixel + stride);
            const auto areLinked = [&](auto a, auto b) HWY_ATTR {  // false where either is NaN
                return BitsOf(d, hn::Lt(hn::Abs(hn::Sub(a, b)), step)) << n;
            };
            present |= BitsOf(d, hn::Eq(own, own)) << n;
            above |= areLinked(hn::LoadU(d, pixel + 1), own);
            right |= areLinked(on_right, own);
            right_above |= areLinked(hn::LoadU(d, pixel + stride + 1), on_right);
        }
        const int inside = pixels - first;
        const std::uint64_t mask =
            inside < PixelLinks::kWord ? (std::uint64_t{1} << inside) - 1 : ~std::uint64_t{0};
        links.present[word] = present & mask;
        links.above[word] = above & mask;
        links.right[word] = right & mask;
        const std::uint64_t same = right & above & right_above;
        links.first_right[word] = right & mask & ~(same << 1 | same_below);
        same_below = same >> 63;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(FindLinks);

}  // namespace

void findLinks(float max_step, PixelLinks& links) {
    for (auto* bits : {&links.present, &links.above, &links.right, &links.first_right})
        bits->resize(links.words());
    HWY_DYNAMIC_DISPATCH(FindLinks)(max_step, links);
}

}  // namespace hagen
#endif
