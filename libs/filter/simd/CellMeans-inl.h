// Step 3 of the ground surface fit: a cell's height is the mean of its candidates close to the
// lowest; its weight grows with their number. For files that Highway compiles once per instruction
// set.
#ifndef HAGEN_CELL_MEANS
#define HAGEN_CELL_MEANS
#include <hagen/filter/GroundFit.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "filter/simd/GroundGrid-inl.h"

namespace hagen {
namespace {

using namespace surface_rules;

/// Sums the candidates of each cell that are close to the lowest candidate, `ground_m`.
template <int kSide>
void sumUpClose(GroundFit<kSide>& fit, const float* ground_m) {
    for (auto* sums : {&fit.sum_m, &fit.number}) std::fill(sums->begin(), sums->end(), 0.0f);
    float *const sum_m = fit.sum_m.data(), *const number = fit.number.data();
    const std::int32_t* const cell = fit.cell.data();
    const float* const z_m = fit.z_m.data();
    visitByTurns(
        fit.candidates, [=](std::size_t k) __attribute__((always_inline)) {
            const float above_m = z_m[k] - ground_m[cell[k]];
            // 1 for ground, otherwise 0. A plain condition would be compiled to a branch.
            const float is_ground =
                static_cast<float>((above_m >= -kBelowLowest_m) & (above_m <= kAboveLowest_m));
            sum_m[cell[k]] += is_ground * z_m[k];
            number[cell[k]] += is_ground;
        });
}

}  // namespace
}  // namespace hagen
#endif

#if defined(HAGEN_CELL_MEANS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_CELL_MEANS_INL
#undef HAGEN_CELL_MEANS_INL
#else
#define HAGEN_CELL_MEANS_INL
#endif

#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Converts sums and counts to weighted means and weights.
template <int kSide>
void weighMeans(GroundFit<kSide>& fit) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            float* HWY_RESTRICT sum_m = fit.sum_m.data() + gridColumn<kSide>(j) + i;
            float* HWY_RESTRICT number = fit.number.data() + gridColumn<kSide>(j) + i;
            const V n = hn::LoadU(d, number), one = hn::Set(d, 1.0f);
            if (hn::AllTrue(d, hn::Eq(n, hn::Zero(d)))) continue;  // true for most cells
            const V weight = hn::Min(hn::Mul(n, hn::Set(d, 1 / kSureReturns)), one);
            const V mean_m = hn::Div(hn::LoadU(d, sum_m), hn::Max(n, one));
            hn::StoreU(hn::Mul(mean_m, weight), d, sum_m);
            hn::StoreU(weight, d, number);
        }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
