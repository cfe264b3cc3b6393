#include "filter/simd/ObstacleFeet.h"
#include <algorithm>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/ObstacleFeet.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"
#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

using namespace feet_rules;

/// Lists, in order, the pixels that may be a foot: ROU above kFootHeight_m with a RoI pixel among
/// the next kFootRows in memory. Always includes the last few pixels of the image.
std::size_t ListFeetIn(std::size_t pixels, const float* HWY_RESTRICT height_m,
                       const std::uint8_t* HWY_RESTRICT label, std::int32_t* HWY_RESTRICT list) {
    std::int32_t* end = list;
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t pixel = 0;
    for (; pixel + lanes + kFootRows <= pixels; pixel += lanes) {
        const auto labelsFrom = [&](std::size_t first) HAGEN_INLINE {
            return hn::PromoteTo(di, hn::LoadU(d8, label + first));
        };
        auto above = labelsFrom(pixel + 1);  // one bit per label
        for (int rows = 2; rows <= kFootRows; ++rows)
            above = hn::Or(above, labelsFrom(pixel + rows));
        static_assert(static_cast<int>(Label::Rou) == 1 && static_cast<int>(Label::Roi) == 2);
        const auto is_below_roi = hn::Gt(above, hn::Set(di, 1));
        const auto is_rou = hn::Eq(labelsFrom(pixel), hn::Set(di, 1));
        const auto is_high = hn::Gt(hn::LoadU(d, height_m + pixel), hn::Set(d, kFootHeight_m));
        const auto may_be = hn::And(hn::RebindMask(d, hn::And(is_below_roi, is_rou)), is_high);
        end = AppendBits(BitsOf(d, may_be), static_cast<std::int32_t>(pixel), end);
    }
    for (; pixel < pixels; ++pixel) *end++ = static_cast<std::int32_t>(pixel);
    return static_cast<std::size_t>(end - list);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(ListFeetIn);

std::uint8_t* bytesOf(Image<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<std::uint8_t*>(labels.data());
}

/// Whether a ROU pixel is the foot of the RoI pixel above it.
bool isFoot(const PixelPoints& pixels, const Image<float>& height_m, Eigen::Index pixel,
            Eigen::Index above) {
    const Eigen::Vector3f up_m = pixels.at(above) - pixels.at(pixel);
    const bool is_steep =
        up_m.z() * up_m.z() > up_m.x() * up_m.x() + up_m.y() * up_m.y();  // > 45 deg
    return is_steep && above - pixel <= feet_rules::kFootRows &&
           height_m.data()[pixel] > feet_rules::kFootHeight_m;
}

/// Marks `pixel` if it is a foot, and the feet below it in its column.
void growDown(const PixelPoints& pixels, const Image<float>& height_m, Eigen::Index pixel,
              Image<Label>& labels) {
    const Eigen::Index rows = labels.rows(), first = pixel / rows * rows, end = first + rows;
    Label* const label = labels.data();
    Eigen::Index above = pixel + 1;
    while (above < end && label[above] == Label::Unclassified) ++above;
    if (above == end || label[above] != Label::Roi) return;
    while (label[pixel] == Label::Rou && isFoot(pixels, height_m, pixel, above)) {
        label[pixel] = Label::Roi;
        above = pixel;
        do {
            if (pixel == first) return;
            --pixel;
        } while (label[pixel] == Label::Unclassified);
    }
}

}  // namespace

void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels,
              FeetWorkspace& work) {
    const std::size_t size = static_cast<std::size_t>(labels.size());
    work.candidates.resize(std::max(work.candidates.size(), size));
    std::int32_t* const list = work.candidates.data();
    std::size_t n = HWY_DYNAMIC_DISPATCH(ListFeetIn)(size, height_m.data(), bytesOf(labels), list);
    while (n > 0) growDown(pixels, height_m, list[--n], labels);  // from the top down
}

}  // namespace hagen
#endif
