// Step 1 of the ground surface fit: the lowest candidate of each cell, without outliers (mirror
// images and stray returns lie below the ground). For files that Highway compiles once per
// instruction set.
#ifndef HAGEN_LOWEST_CANDIDATES
#define HAGEN_LOWEST_CANDIDATES
#include <hagen/filter/GroundFit.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "filter/simd/GroundGrid-inl.h"

namespace hagen {
namespace {

using namespace surface_rules;

template <int kSide>
void findLowest(GroundFit<kSide>& fit) {
    std::fill(fit.lowest_m.begin(), fit.lowest_m.end(), kNoHeight);
    float* const lowest_m = fit.lowest_m.data();
    const std::int32_t* const cell = fit.cell.data();
    const float* const z_m = fit.z_m.data();
    visitByTurns(
        fit.candidates, [=](std::size_t k) __attribute__((always_inline)) {
            lowest_m[cell[k]] = std::min(lowest_m[cell[k]], z_m[k]);
        });
}

}  // namespace
}  // namespace hagen
#endif

#if defined(HAGEN_LOWEST_CANDIDATES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_LOWEST_CANDIDATES_INL
#undef HAGEN_LOWEST_CANDIDATES_INL
#else
#define HAGEN_LOWEST_CANDIDATES_INL
#endif

#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Raises cells far below several neighbours to the lowest of all neighbours.
template <int kSide>
void removeStrays(const std::vector<float>& lowest_m, std::vector<float>& cleaned_m) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            const float* HWY_RESTRICT cell = lowest_m.data() + gridColumn<kSide>(j) + i;
            const V low_m = hn::LoadU(d, cell), none = hn::Set(d, kNoHeight);
            V cleaned = low_m;
            if (!hn::AllTrue(d, hn::Eq(low_m, none))) {
                const V stray_m = hn::Set(d, kStray_m), one = hn::Set(d, 1.0f);
                V higher = hn::Zero(d), lowest_around_m = none;
                for (const int neighbour :
                     {-kStride<kSide> - 1, -kStride<kSide>, -kStride<kSide> + 1, -1, 1,
                      kStride<kSide> - 1, kStride<kSide>, kStride<kSide> + 1}) {
                    const V around_m = hn::LoadU(d, cell + neighbour);
                    const auto is_higher =
                        hn::And(hn::Gt(hn::Sub(around_m, low_m), stray_m), hn::Lt(around_m, none));
                    higher = hn::Add(higher, hn::IfThenElseZero(is_higher, one));
                    lowest_around_m = hn::Min(lowest_around_m, around_m);
                }
                const auto is_stray =
                    hn::And(hn::Ge(higher, hn::Set(d, kStrayNeighbours)), hn::Lt(low_m, none));
                cleaned = hn::IfThenElse(is_stray, hn::Max(low_m, lowest_around_m), low_m);
            }
            hn::StoreU(cleaned, d, cleaned_m.data() + gridColumn<kSide>(j) + i);
        }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
