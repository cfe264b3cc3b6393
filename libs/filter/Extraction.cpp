#include <hagen/filter/Extraction.h>
#include <algorithm>
#include <limits>
#include "scan/SetBits.h"

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/Extraction.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "filter/ExtractionParts.h"
#include "filter/simd/MaskBits.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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

/// Labels whole words of returns, starting at return `first`. Does not branch on labels, because
/// they are unpredictable.
template <bool kHasOwnLabel>
HWY_INLINE void LabelWordsOf(const ExtractionInput& in, std::uint32_t first, std::size_t words,
                             std::uint64_t last_word_mask, ExtractionOutput& out) {
    const hn::ScalableTag<float> df;
    const hn::RebindToSigned<decltype(df)> d;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const std::size_t lanes = hn::Lanes(d);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1), two = hn::Set(d, 2);
    const auto infinite = hn::Set(df, std::numeric_limits<float>::infinity());
    const auto zone = hn::Set(df, in.zone_m);
    const float* HWY_RESTRICT range_m = in.range_m;
    const std::int32_t* HWY_RESTRICT pixels = in.pixel;
    const std::uint8_t* HWY_RESTRICT own_label = in.own_label;
    const auto* const label_of_pixel = reinterpret_cast<const std::int32_t*>(in.label_of_pixel);
    std::uint8_t* HWY_RESTRICT labels = out.label;
    std::uint32_t *roi = out.roi, *rou = out.rou, *unclassified = out.unclassified;

    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t seen_bits = 0, roi_bits = 0;
        for (std::size_t n = 0; n < kReturnsPerWord; n += lanes) {
            const std::size_t i = word * kReturnsPerWord + n;
            const auto range = hn::LoadU(df, range_m + i);
            const auto pixel = hn::LoadU(d, pixels + i);
            const auto of_pixel =  // the lowest of the four bytes there
                hn::And(hn::GatherOffset(d, label_of_pixel, pixel), hn::Set(d, 255));
            const auto is_seen =
                hn::And(hn::Gt(range, hn::Zero(df)), hn::Lt(range, infinite));  // false for NaN
            auto is_rou = hn::Eq(of_pixel, one);
            if (kHasOwnLabel) {
                const auto own = hn::PromoteTo(d, hn::LoadU(d8, own_label + i));
                is_rou = hn::Or(hn::Eq(own, one), hn::And(hn::Eq(own, zero), is_rou));
            }
            const auto is_far = hn::RebindMask(d, hn::Gt(range, zone));
            const auto seen = hn::RebindMask(d, is_seen);
            const auto is_roi = hn::AndNot(hn::Or(is_far, is_rou), seen);
            const auto label = hn::IfThenElseZero(seen, hn::IfThenElse(is_roi, two, one));
            hn::StoreU(hn::DemoteTo(d8, label), d8, labels + i);
            seen_bits |= BitsOf(d, seen) << n;
            roi_bits |= BitsOf(d, is_roi) << n;
        }
        const std::uint64_t mask = word + 1 < words ? ~std::uint64_t{0} : last_word_mask;
        const auto index = static_cast<std::uint32_t>(first + word * kReturnsPerWord);
        roi = AppendWord(roi_bits & mask, index, roi);
        rou = AppendWord(seen_bits & ~roi_bits & mask, index, rou);
        unclassified = AppendWord(~seen_bits & mask, index, unclassified);
    }
    out.roi = roi;
    out.rou = rou;
    out.unclassified = unclassified;
}

void LabelWords(const ExtractionInput& in, std::uint32_t first, std::size_t words,
                std::uint64_t last_word_mask, ExtractionOutput& out) {
    if (in.own_label != nullptr) {
        LabelWordsOf<true>(in, first, words, last_word_mask, out);
    } else {
        LabelWordsOf<false>(in, first, words, last_word_mask, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <array>

namespace hagen {
namespace {

HWY_EXPORT(LabelWords);

const std::uint8_t* bytesOf(const std::vector<Label>& labels) {
    static_assert(sizeof(Label) == 1);
    return reinterpret_cast<const std::uint8_t*>(labels.data());
}

/// Labels the last returns, which do not fill a word, in word-sized copies.
void labelRest(ExtractionInput in, std::size_t first, std::size_t rest, ExtractionOutput& out) {
    std::array<float, kReturnsPerWord> range_m{};
    std::array<std::int32_t, kReturnsPerWord> pixel{};
    std::array<std::uint8_t, kReturnsPerWord> own{}, label{};
    std::copy_n(in.range_m + first, rest, range_m.data());
    std::copy_n(in.pixel + first, rest, pixel.data());
    if (in.own_label != nullptr) std::copy_n(in.own_label + first, rest, own.data());
    in.range_m = range_m.data();
    in.pixel = pixel.data();
    if (in.own_label != nullptr) in.own_label = own.data();
    std::uint8_t* const last_labels = out.label + first;
    out.label = label.data();
    HWY_DYNAMIC_DISPATCH(LabelWords)
    (in, static_cast<std::uint32_t>(first), 1, (std::uint64_t{1} << rest) - 1, out);
    std::copy_n(label.data(), rest, last_labels);
}

void labelReturns(const ExtractionInput& in, std::size_t size, ExtractionOutput& out) {
    const std::size_t words = size / kReturnsPerWord, whole = words * kReturnsPerWord;
    HWY_DYNAMIC_DISPATCH(LabelWords)(in, 0, words, ~std::uint64_t{0}, out);
    if (size > whole) labelRest(in, whole, size - whole, out);
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
    labelReturns(in, size, out);
    returns.roi.assign(work.roi.data(), out.roi);
    returns.rou.assign(work.rou.data(), out.rou);
    returns.unclassified.assign(work.unclassified.data(), out.unclassified);
}

}  // namespace hagen
#endif
