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
HWY_INLINE void LabelWordsOf(const ExtractionRules& rules, const ExtractionInput& in,
                             std::uint32_t first, std::size_t words, std::uint64_t last_word_mask,
                             ExtractionOutput& out) {
    const hn::ScalableTag<float> df;
    const hn::RebindToSigned<decltype(df)> d;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const std::size_t lanes = hn::Lanes(d);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1), two = hn::Set(d, 2);
    const auto infinite = hn::Set(df, std::numeric_limits<float>::infinity());
    const auto zone = hn::Set(df, rules.zone_m);
    const float* HWY_RESTRICT range_m = in.range_m;
    const std::int32_t* HWY_RESTRICT pixels = in.pixel;
    const std::uint8_t* HWY_RESTRICT own_label = in.own_label;
    const std::int32_t* HWY_RESTRICT verdict_of_pixel = in.verdict_of_pixel;
    std::uint8_t* HWY_RESTRICT labels = out.label;
    std::int32_t* HWY_RESTRICT components = out.component;
    std::uint32_t *roi = out.roi, *rou = out.rou, *unclassified = out.unclassified;
    auto max = zero;

    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t seen_bits = 0, roi_bits = 0;
        for (std::size_t n = 0; n < kReturnsPerWord; n += lanes) {
            const std::size_t i = word * kReturnsPerWord + n;
            const auto range = hn::LoadU(df, range_m + i);
            const auto pixel = hn::LoadU(d, pixels + i);
            const auto verdict = hn::GatherIndex(d, verdict_of_pixel, pixel);
            const auto is_seen =
                hn::And(hn::Gt(range, hn::Zero(df)), hn::Lt(range, infinite));  // false for NaN
            auto is_rou = hn::Eq(hn::And(verdict, one), one);
            if (kHasOwnLabel) {
                const auto own = hn::PromoteTo(d, hn::LoadU(d8, own_label + i));
                is_rou = hn::Or(hn::Eq(own, one), hn::And(hn::Eq(own, zero), is_rou));
            }
            const auto is_far = hn::RebindMask(d, hn::Gt(range, zone));
            const auto seen = hn::RebindMask(d, is_seen);
            const auto is_roi = hn::AndNot(hn::Or(is_far, is_rou), seen);
            const auto label = hn::IfThenElseZero(seen, hn::IfThenElse(is_roi, two, one));
            hn::StoreU(hn::DemoteTo(d8, label), d8, labels + i);
            const auto component = hn::IfThenElseZero(is_roi, hn::ShiftRight<1>(verdict));
            max = hn::Max(max, component);
            hn::StoreU(component, d, components + i);
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
    out.max_components = std::max(out.max_components, hn::GetLane(hn::MaxOfLanes(d, max)));
}

void LabelWords(const ExtractionRules& rules, const ExtractionInput& in, std::uint32_t first,
                std::size_t words, std::uint64_t last_word_mask, ExtractionOutput& out) {
    if (in.own_label != nullptr) {
        LabelWordsOf<true>(rules, in, first, words, last_word_mask, out);
    } else {
        LabelWordsOf<false>(rules, in, first, words, last_word_mask, out);
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

/// For each pixel, 2 * component + 1 if ROU, so that a return needs one look-up. A return without a
/// pixel is RoI without a component.
void findVerdicts(const Image<Label>& labels, const Image<std::int32_t>& components,
                  std::vector<std::int32_t>& verdict) {
    verdict.resize(static_cast<std::size_t>(labels.size()) + 1);
    verdict[0] = 0;
    const Label* const label = labels.data();
    const std::int32_t* const component = components.data();
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        verdict[pixel + 1] = component[pixel] * 2 + (label[pixel] == Label::Rou);
    }
}

/// Removes returns with their own label from their pixel's component if they are too far from it.
void leaveComponents(const std::vector<std::int32_t>& own_labelled, const Scan& scan,
                     const RangeImage& image, float component_gap_m,
                     std::vector<std::int32_t>& component) {
    for (const std::int32_t i : own_labelled) {
        if (component[i] == 0) continue;  // includes returns without a pixel
        const float apart_m =
            std::abs(scan.range_m[i] - image.depth_m.data()[image.depth_mapper[i]]);
        component[i] = apart_m < component_gap_m ? component[i] : 0;
    }
}

/// Renumbers components 1, 2, ... in order, skipping components without returns (all their pixels
/// were repaired). `max` is the highest number. Only RoI returns belong to components.
void renumber(std::int32_t max, LabelledReturns& returns, std::vector<std::int32_t>& number) {
    std::vector<std::int32_t>& component = returns.component;
    number.assign(static_cast<std::size_t>(max) + 1, 0);
    for (const std::uint32_t i : returns.roi) number[component[i]] = 1;
    number[0] = 0;
    for (std::size_t c = 1; c < number.size(); ++c) number[c] += number[c - 1];
    if (number.back() == max) return;  // no gaps
    for (const std::uint32_t i : returns.roi) component[i] = number[component[i]];
}

/// Labels the last returns, which do not fill a word, in word-sized copies.
void labelRest(const ExtractionRules& rules, ExtractionInput in, std::size_t first,
               std::size_t rest, ExtractionOutput& out) {
    std::array<float, kReturnsPerWord> range_m{};
    std::array<std::int32_t, kReturnsPerWord> pixel{}, component{};
    std::array<std::uint8_t, kReturnsPerWord> own{}, label{};
    std::copy_n(in.range_m + first, rest, range_m.data());
    std::copy_n(in.pixel + first, rest, pixel.data());
    if (in.own_label != nullptr) std::copy_n(in.own_label + first, rest, own.data());
    in.range_m = range_m.data();
    in.pixel = pixel.data();
    if (in.own_label != nullptr) in.own_label = own.data();
    std::uint8_t* const last_labels = out.label + first;
    std::int32_t* const last_components = out.component + first;
    out.label = label.data();
    out.component = component.data();
    HWY_DYNAMIC_DISPATCH(LabelWords)
    (rules, in, static_cast<std::uint32_t>(first), 1, (std::uint64_t{1} << rest) - 1, out);
    std::copy_n(label.data(), rest, last_labels);
    std::copy_n(component.data(), rest, last_components);
}

void labelReturns(const ExtractionRules& rules, const ExtractionInput& in, std::size_t size,
                  ExtractionOutput& out) {
    const std::size_t words = size / kReturnsPerWord, whole = words * kReturnsPerWord;
    HWY_DYNAMIC_DISPATCH(LabelWords)(rules, in, 0, words, ~std::uint64_t{0}, out);
    if (size > whole) labelRest(rules, in, whole, size - whole, out);
}

}  // namespace

void extractReturns(const Scan& scan, const LabelledImage& image, const OwnLabels& own_labels,
                    const ExtractionRules& rules, LabelledReturns& returns,
                    ExtractionWorkspace& work) {
    static_assert(RangeImage::kNoPixel == -1 && static_cast<int>(Label::Roi) == 2 &&
                  static_cast<int>(Label::Rou) == 1 && static_cast<int>(Label::Unclassified) == 0);
    const std::size_t size = scan.size();
    for (auto* list : {&work.roi, &work.rou, &work.unclassified}) {
        if (list->size() < size + kReturnsPerWord) list->resize(size + kReturnsPerWord);
    }
    returns.label.resize(size);
    returns.component.resize(size);
    findVerdicts(image.labels, image.components, work.verdict);

    const std::vector<Label>& own = own_labels.label;
    const ExtractionInput in{
        scan.range_m.data(), image.range_image.depth_mapper.data(),
        own.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(own.data()),
        work.verdict.data() + 1};
    ExtractionOutput out{reinterpret_cast<std::uint8_t*>(returns.label.data()),
                         returns.component.data(),
                         work.roi.data(),
                         work.rou.data(),
                         work.unclassified.data(),
                         0};
    labelReturns(rules, in, size, out);
    returns.roi.assign(work.roi.data(), out.roi);
    returns.rou.assign(work.rou.data(), out.rou);
    returns.unclassified.assign(work.unclassified.data(), out.unclassified);
    leaveComponents(own_labels.returns, scan, image.range_image, rules.component_gap_m,
                    returns.component);
    renumber(out.max_components, returns, work.number);
}

}  // namespace hagen
#endif
