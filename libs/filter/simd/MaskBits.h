// For files that Highway compiles once per instruction set; include it after highway.h.
#if defined(HAGEN_MASK_BITS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_MASK_BITS_H
#undef HAGEN_MASK_BITS_H
#else
#define HAGEN_MASK_BITS_H
#endif
#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {

/// One bit per lane, lane 0 lowest, for up to 64 lanes.
template <class D, class Mask>
HWY_INLINE std::uint64_t BitsOf(D d, Mask mask) {
    std::uint8_t bytes[8] = {};
    hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}

/// Appends `first` + n for each set bit n; returns the new end.
template <class Index>
HWY_INLINE Index* AppendBits(std::uint64_t bits, Index first, Index* list) {
    for (; bits != 0; bits &= bits - 1) {
        *list++ = first + static_cast<Index>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    }
    return list;
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
