// Step 2 of the ground surface fit: a cell is not ground if its lowest candidate is higher than
// slopes from lower cells allow. The envelope of these slopes is a chamfer transform, computed one
// vector of a column's cells at a time. For files that Highway compiles once per instruction set.
#ifndef HAGEN_OBSTACLE_REMOVAL
#define HAGEN_OBSTACLE_REMOVAL
#include <hagen/filter/GroundFit.h>
#include <hagen/filter/GroundSurface.h>
#include <algorithm>

namespace hagen {
namespace {

using namespace surface_rules;

/// The width of a cell on a grid of kSide x kSide cells.
template <int kSide>
constexpr float kWidth_m = GroundSurface::kCell_m* GroundSurface::kCells / kSide;

}  // namespace
}  // namespace hagen
#endif

#if defined(HAGEN_OBSTACLE_REMOVAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_OBSTACLE_REMOVAL_INL
#undef HAGEN_OBSTACLE_REMOVAL_INL
#else
#define HAGEN_OBSTACLE_REMOVAL_INL
#endif

#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// A vector of consecutive cells along a column.
using Along = hn::CappedTag<float, 8>;
using VA = hn::Vec<Along>;

/// Prefix scan of a vector: combines each cell with all cells before it. `neutral` is the neutral
/// element.
template <bool kForward, class Combine>
HWY_INLINE VA combinedSoFar(VA cells, VA neutral, Combine combine) {
#if HWY_TARGET == HWY_SCALAR
    (void)neutral, (void)combine;
    return cells;
#else
    const Along d;
    if constexpr (kForward) {
        cells = combine(cells, hn::CombineShiftRightBytes<12>(d, cells, neutral));
        cells = combine(cells, hn::CombineShiftRightBytes<8>(d, cells, neutral));
        if constexpr (hn::MaxLanes(d) == 8) {
            cells = combine(cells, hn::ConcatLowerLower(d, hn::Broadcast<3>(cells), neutral));
        }
    } else {
        cells = combine(cells, hn::CombineShiftRightBytes<4>(d, neutral, cells));
        cells = combine(cells, hn::CombineShiftRightBytes<8>(d, neutral, cells));
        if constexpr (hn::MaxLanes(d) == 8) {
            cells = combine(cells, hn::ConcatUpperUpper(d, neutral, hn::Broadcast<0>(cells)));
        }
    }
    return cells;
#endif
}

/// Broadcasts the last cell.
template <bool kForward>
HWY_INLINE VA lastOf(VA cells) {
#if HWY_TARGET == HWY_SCALAR
    return cells;
#else
    const Along d;
    if constexpr (kForward) {
        cells = hn::Broadcast<3>(cells);
        return hn::MaxLanes(d) == 8 ? hn::ConcatUpperUpper(d, cells, cells) : cells;
    } else {
        cells = hn::Broadcast<0>(cells);
        return hn::MaxLanes(d) == 8 ? hn::ConcatLowerLower(d, cells, cells) : cells;
    }
#endif
}

/// The maximum climb of the ground along a column, from its edge to each cell: a step per cell with
/// a height, and a smaller step per cell without a height.
template <int kSide>
HWY_INLINE void findRamp(const float* HWY_RESTRICT cleaned_m, float* HWY_RESTRICT ramp_m) {
    const Along d;
    const VA seen_m = hn::Set(d, kWidth_m<kSide> * kSteepest), one = hn::Set(d, 1.0f);
    const VA unseen_m = hn::Set(d, kWidth_m<kSide> * kSteepestUnseen);
    VA seen = hn::Zero(d);  // number of cells with a height in the previous vectors
    ramp_m[-1] = 0;
    for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
        const auto is_seen = hn::Lt(hn::LoadU(d, cleaned_m + i), hn::Set(d, kNoHeight));
        const auto sum = [](VA a, VA b) HAGEN_INLINE { return hn::Add(a, b); };
        const VA more = combinedSoFar<true>(hn::IfThenElseZero(is_seen, one), hn::Zero(d), sum);
        const VA number = hn::Add(seen, more);
        const VA others = hn::Sub(hn::Iota(d, static_cast<float>(i + 1)), number);
        hn::StoreU(hn::Add(hn::Mul(number, seen_m), hn::Mul(others, unseen_m)), d, ramp_m + i);
        seen = hn::Add(seen, lastOf<true>(more));
    }
}

/// Computes a column in a pass of the chamfer transform (Borgefors 1986). Along the column, a cell
/// is reached from all previous cells. Relative to the ramp, this is a plain minimum.
template <int kSide, bool kForward>
HWY_INLINE void chamferColumn(const float* HWY_RESTRICT cleaned_m, const float* HWY_RESTRICT ramp_m,
                              const float* HWY_RESTRICT before_m, float* HWY_RESTRICT envelope_m) {
    const Along d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const VA none = hn::Set(d, kNoHeight), corner = hn::Set(d, kDiagonal);
    const VA seen_m = hn::Set(d, kWidth_m<kSide> * kSteepest);
    const VA unseen_m = hn::Set(d, kWidth_m<kSide> * kSteepestUnseen);
    const auto lower = [](VA a, VA b) HAGEN_INLINE { return hn::Min(a, b); };
    VA lowest_m = none;  // minimum of the previous vectors, relative to the ramp
    for (int step = 0; step < kSide; step += lanes) {
        const int i = kForward ? step : kSide - lanes - step;
        const auto is_seen = hn::Lt(hn::LoadU(d, cleaned_m + i), none);
        const VA side_m = hn::IfThenElse(is_seen, seen_m, unseen_m);
        const VA corners_m =
            hn::Min(hn::LoadU(d, before_m + i - 1), hn::LoadU(d, before_m + i + 1));
        const VA from_side_m = hn::Add(hn::LoadU(d, before_m + i), side_m);
        const VA from_corners_m = hn::Add(corners_m, hn::Mul(corner, side_m));
        const VA own_m =
            hn::Min(hn::LoadU(d, envelope_m + i), hn::Min(from_side_m, from_corners_m));
        const VA climb_m =
            kForward ? hn::LoadU(d, ramp_m + i) : hn::Neg(hn::LoadU(d, ramp_m + i - 1));
        const VA against_m = combinedSoFar<kForward>(hn::Sub(own_m, climb_m), none, lower);
        const VA reached_m = hn::Add(hn::Min(lowest_m, against_m), climb_m);
        hn::StoreU(hn::Min(own_m, reached_m), d, envelope_m + i);
        lowest_m = hn::Min(lowest_m, lastOf<kForward>(against_m));
    }
}

/// Computes the envelope, the highest surface below `cleaned_m` that is nowhere too steep:
/// kSteepest in cells with a height, kSteepestUnseen in others. Cells above it become empty.
template <int kSide>
void removeObstacles(GroundFit<kSide>& fit) {
    std::copy(fit.cleaned_m.begin(), fit.cleaned_m.end(), fit.envelope_m.begin());
    float* const cleaned = fit.cleaned_m.data();
    float* const e = fit.envelope_m.data();
    float* const ramp = fit.ramp_m.data();
    for (int j = 0; j < kSide; ++j) {
        const int column = gridColumn<kSide>(j);
        findRamp<kSide>(cleaned + column, ramp + column);
        chamferColumn<kSide, true>(cleaned + column, ramp + column, e + column - kStride<kSide>,
                                   e + column);
    }
    for (int j = kSide - 1; j >= 0; --j) {
        const int column = gridColumn<kSide>(j);
        chamferColumn<kSide, false>(cleaned + column, ramp + column, e + column + kStride<kSide>,
                                    e + column);
    }
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            float* HWY_RESTRICT cell = cleaned + gridColumn<kSide>(j) + i;
            const V low_m = hn::LoadU(d, cell);
            const V max_m =
                hn::Add(hn::LoadU(d, e + gridColumn<kSide>(j) + i), hn::Set(d, kEnvelope_m));
            hn::StoreU(hn::IfThenElse(hn::Le(low_m, max_m), low_m, hn::Set(d, kNoHeight)), d, cell);
        }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
