#include <hagen/filter/Extraction.h>
#include <algorithm>
#include <limits>
#include "scan/SetBits.h"

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/Extraction.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"
#include "filter/simd/MaskBits.h"

#ifndef HAGEN_EXTRACTION
#define HAGEN_EXTRACTION
namespace hagen {
namespace {

constexpr std::size_t kReturnsPerWord = 64;

/// Labels are stored as numbers.
struct ExtractionInput {
    const float* range_m;
    const std::int32_t* pixel;
    const std::uint8_t* own_label;       ///< null if no return has its own label
    const std::uint8_t* label_of_pixel;  ///< index -1 is for no pixel; has three spare bytes
    float zone_m;
};

struct ExtractionOutput {
    std::uint8_t* label;
    std::uint32_t *roi, *rou, *unclassified;  ///< ends of the lists; writes may overrun by one word
};

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// Appends `first` + n for each set bit n. Copies eight table entries per byte; the next byte
/// overwrites the surplus.
HWY_INLINE std::uint32_t* AppendWord(std::uint64_t bits, std::uint32_t first,
                                     std::uint32_t* HWY_RESTRICT list) {
    const hn::CappedTag<std::uint32_t, 8> d;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    for (std::uint32_t n = 0; n < kReturnsPerWord; n += 8) {
        const std::size_t byte = bits >> n & 255;
        for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
            const auto place = hn::PromoteTo(d, hn::LoadU(d8, kSetBits.place[byte].data() + k));
            hn::StoreU(hn::Add(place, hn::Set(d, first + n)), d, list + k);
        }
        list += kSetBits.count[byte];
    }
    return list;
}

/// Labels the returns, in words. Does not branch on labels, because they are unpredictable.
template <bool kHasOwnLabel>
HWY_INLINE void LabelReturnsOf(const ExtractionInput& in, std::size_t size, ExtractionOutput& out) {
    const auto* const label_of_pixel = reinterpret_cast<const std::int32_t*>(in.label_of_pixel);
    for (std::size_t first = 0; first < size; first += kReturnsPerWord) {
        const std::size_t returns = std::min(size - first, kReturnsPerWord);
        std::uint64_t seen_bits = 0, roi_bits = 0;
        forEachVector(returns, [&](auto df, std::size_t n) HAGEN_INLINE {
            const hn::RebindToSigned<decltype(df)> d;
            const hn::Rebind<std::uint8_t, decltype(d)> d8;
            const auto one = hn::Set(d, 1), two = hn::Set(d, 2);
            const std::size_t i = first + n;
            const auto range = hn::LoadU(df, in.range_m + i);
            const auto of_pixel =  // the lowest of the four bytes there
                hn::And(hn::GatherOffset(d, label_of_pixel, hn::LoadU(d, in.pixel + i)),
                        hn::Set(d, 255));
            const auto infinite = hn::Set(df, std::numeric_limits<float>::infinity());
            const auto is_seen =
                hn::And(hn::Gt(range, hn::Zero(df)), hn::Lt(range, infinite));  // false for NaN
            auto is_rou = hn::Eq(of_pixel, one);
            if (kHasOwnLabel) {
                const auto own = hn::PromoteTo(d, hn::LoadU(d8, in.own_label + i));
                is_rou = hn::Or(hn::Eq(own, one), hn::And(hn::Eq(own, hn::Zero(d)), is_rou));
            }
            const auto is_far = hn::RebindMask(d, hn::Gt(range, hn::Set(df, in.zone_m)));
            const auto seen = hn::RebindMask(d, is_seen);
            const auto is_roi = hn::AndNot(hn::Or(is_far, is_rou), seen);
            const auto label = hn::IfThenElseZero(seen, hn::IfThenElse(is_roi, two, one));
            hn::StoreU(hn::DemoteTo(d8, label), d8, out.label + i);
            seen_bits |= BitsOf(d, seen) << n;
            roi_bits |= BitsOf(d, is_roi) << n;
        });
        const std::uint64_t all = ~std::uint64_t{0} >> (kReturnsPerWord - returns);
        const auto index = static_cast<std::uint32_t>(first);
        out.roi = AppendWord(roi_bits, index, out.roi);
        out.rou = AppendWord(seen_bits & ~roi_bits, index, out.rou);
        out.unclassified = AppendWord(~seen_bits & all, index, out.unclassified);
    }
}

void LabelReturnsIn(const ExtractionInput& in, std::size_t size, ExtractionOutput& out) {
    if (in.own_label != nullptr) return LabelReturnsOf<true>(in, size, out);
    LabelReturnsOf<false>(in, size, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(LabelReturnsIn);

const std::uint8_t* bytesOf(const std::vector<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<const std::uint8_t*>(labels.data());
}

}  // namespace

void extractReturns(const Scan& scan, const RangeImage& image, const Image<Label>& labels,
                    const OwnLabels& own_labels, float zone_m, LabelledReturns& returns,
                    ExtractionWorkspace& work) {
    static_assert(RangeImage::kNoPixel == -1 && static_cast<int>(Label::Roi) == 2 &&
                  static_cast<int>(Label::Rou) == 1 && static_cast<int>(Label::Unclassified) == 0);
    const std::size_t size = scan.size();
    for (auto* list : {&work.roi, &work.rou, &work.unclassified}) {
        if (list->size() < size + kReturnsPerWord) list->resize(size + kReturnsPerWord);
    }
    returns.label.resize(size);
    const auto pixels = static_cast<std::size_t>(labels.size());
    work.label_of_pixel.resize(pixels + sizeof(std::int32_t));  // look-ups read four bytes
    work.label_of_pixel[0] = Label::Unclassified;
    std::copy_n(labels.data(), pixels, work.label_of_pixel.data() + 1);

    const std::vector<Label>& own = own_labels.label;
    const ExtractionInput in{scan.range_m.data(), image.depth_mapper.data(),
                             own.empty() ? nullptr : bytesOf(own), bytesOf(work.label_of_pixel) + 1,
                             zone_m};
    ExtractionOutput out{reinterpret_cast<std::uint8_t*>(returns.label.data()), work.roi.data(),
                         work.rou.data(), work.unclassified.data()};
    HWY_DYNAMIC_DISPATCH(LabelReturnsIn)(in, size, out);
    returns.roi.assign(work.roi.data(), out.roi);
    returns.rou.assign(work.rou.data(), out.rou);
    returns.unclassified.assign(work.unclassified.data(), out.unclassified);
}

}  // namespace hagen
#endif
