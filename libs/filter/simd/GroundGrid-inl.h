// Vectorised access to the ground grid. For files that Highway compiles once per instruction set.
#ifndef HAGEN_GROUND_GRID
#define HAGEN_GROUND_GRID
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include "scan/InstructionSets.h"
#include "scan/SetBits.h"

#include "filter/ground/GroundGrid.h"
#include "filter/ground/StageRules.h"
#endif

#if defined(HAGEN_GROUND_GRID_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_GROUND_GRID_INL
#undef HAGEN_GROUND_GRID_INL
#else
#define HAGEN_GROUND_GRID_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Forces inlining of a lambda.
#undef HAGEN_INLINE
#define HAGEN_INLINE HWY_ATTR __attribute__((always_inline))

/// Calls visit(d, i) for `size` floats: i is the first of a vector, d its tag. The last few are
/// visited one by one, as vectors of one lane. `visit` must be HAGEN_INLINE.
template <class Visit>
HWY_INLINE void forEachVector(std::size_t size, Visit visit) {
    const hn::ScalableTag<float> d;
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) visit(d, i);
    for (; i < size; ++i) visit(hn::CappedTag<float, 1>(), i);
}

/// Moves the selected lanes of two vectors to the front of each; returns their number. Highway's
/// Compress() copies its 1 KB table on every call when GCC compiles it for AVX2.
template <class D, class VF, class VI>
HWY_INLINE std::size_t compress(D d, hn::Mask<D> is_chosen, VF& floats, VI& integers) {
    const hn::RebindToSigned<D> di;
#if HWY_TARGET == HWY_AVX2
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, is_chosen, bits);
    const hn::Rebind<std::uint8_t, D> d8;
    const auto lanes = hn::PromoteTo(di, hn::LoadU(d8, kSetBits.place[bits[0]].data()));
    floats = hn::TableLookupLanes(floats, hn::IndicesFromVec(d, lanes));
    integers = hn::TableLookupLanes(integers, hn::IndicesFromVec(di, lanes));
#else
    floats = hn::Compress(floats, is_chosen);
    integers = hn::Compress(integers, hn::RebindMask(di, is_chosen));
#endif
    return hn::CountTrue(d, is_chosen);
}

/// Calls visit(value, place) for the pixels that choose(d, pixel, values, places) selects. Lists
/// them in advance, a part of the image at a time, because the branch is unpredictable.
template <class Choose, class Visit>
HWY_INLINE void visitChosen(std::size_t pixels, Choose choose, Visit visit) {
    constexpr std::size_t kPart = 1024, kMaxWidth = 64;  // writes whole vectors
    HWY_ALIGN float value[kPart + kMaxWidth];
    HWY_ALIGN std::int32_t place[kPart + kMaxWidth];
    for (std::size_t first = 0; first < pixels; first += kPart) {
        std::size_t chosen = 0;
        forEachVector(std::min(kPart, pixels - first), [&](auto d, std::size_t k) HAGEN_INLINE {
            const hn::RebindToSigned<decltype(d)> di;
            auto values = hn::Zero(d);
            auto places = hn::Zero(di);
            const auto is_chosen = choose(d, first + k, values, places);
            const std::size_t more = compress(d, is_chosen, values, places);
            hn::StoreU(values, d, value + chosen);
            hn::StoreU(places, di, place + chosen);
            chosen += more;
        });
        const std::size_t quarter = chosen / 4;  // in turns, like visitByTurns()
        for (std::size_t k = 0; k < quarter; ++k) {
            for (std::size_t turn = 0; turn < 4; ++turn) {
                visit(value[k + turn * quarter], place[k + turn * quarter]);
            }
        }
        for (std::size_t k = 4 * quarter; k < chosen; ++k) visit(value[k], place[k]);
    }
}

/// A coordinate of points after a rotation and a translation.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V movedAlong(D d, int axis, const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift_m,
                        V x, V y, V z) {
    const V xy =
        hn::Add(hn::Mul(hn::Set(d, turn(axis, 0)), x), hn::Mul(hn::Set(d, turn(axis, 1)), y));
    return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, turn(axis, 2)), z)), hn::Set(d, shift_m[axis]));
}

/// Gathers the values at these indices.
template <class D>
HWY_INLINE hn::Vec<D> gatherAt(D d, const float* HWY_RESTRICT values,
                               const std::uint16_t* HWY_RESTRICT index) {
    const hn::Rebind<std::uint16_t, D> d16;
    return hn::GatherIndex(d, values,
                           hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(d16, index)));
}

/// The cells of points; points that are not on the grid get border cells.
template <class D>
struct GridCells {
    hn::Vec<hn::RebindToSigned<D>> i, j;  ///< 1 is the first cell, 0 the border before it
    hn::Vec<hn::RebindToSigned<D>> cell;
    hn::Mask<D> is_on_grid;
};

template <int kSide = GroundSurface::kCells, class D, class V = hn::Vec<D>>
HWY_INLINE GridCells<D> gridCells(D d, V x_m, V y_m) {
    const hn::RebindToSigned<D> di;
    const V cells_per_m = hn::Set(d, kSide / (GroundSurface::kCells * GroundSurface::kCell_m));
    const V middle = hn::Set(d, kSide / 2 + 1), last = hn::Set(d, kStride<kSide> - 1);
    const V u = hn::Add(hn::Mul(x_m, cells_per_m), middle);
    const V v = hn::Add(hn::Mul(y_m, cells_per_m), middle);
    const auto whole = [&](V cell) HWY_ATTR {  // 0 for NaN
        const V positive = hn::IfThenElseZero(hn::Gt(cell, hn::Zero(d)), cell);
        return hn::ConvertTo(di, hn::Min(positive, last));
    };
    const auto isInside = [&](V cell) HWY_ATTR {
        return hn::And(hn::Ge(cell, hn::Set(d, 1.0f)), hn::Lt(cell, last));
    };
    const auto i = whole(u), j = whole(v);
    const auto column = hn::Add(hn::ShiftLeft<kLog2<kSide>>(j), hn::ShiftLeft<1>(j));
    return {i, j, hn::Add(column, i), hn::And(isInside(u), isInside(v))};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
