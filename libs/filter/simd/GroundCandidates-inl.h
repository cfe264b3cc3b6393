// Lists the candidate pixels for the ground surface fit, with compressing stores. For files that
// Highway compiles once per instruction set.
#ifndef HAGEN_GROUND_CANDIDATES
#define HAGEN_GROUND_CANDIDATES
#include <hagen/filter/GroundFit.h>
#include <cstddef>
#include <cstdint>

namespace hagen {
namespace {

using namespace surface_rules;

struct PixelSpan {
    const float *x_m, *y_m, *z_m;
    std::size_t size;

    PixelSpan part(std::size_t first, std::size_t of_size) const {
        return {x_m + first, y_m + first, z_m + first, of_size};
    }
};

}  // namespace
}  // namespace hagen
#endif

#if defined(HAGEN_GROUND_CANDIDATES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_GROUND_CANDIDATES_INL
#undef HAGEN_GROUND_CANDIDATES_INL
#else
#define HAGEN_GROUND_CANDIDATES_INL
#endif

#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// Appends the pixels on the grid for which isCandidate(d, pixel, x_m, y_m, cell) to the list.
template <int kSide, class IsCandidate>
HWY_INLINE void listCandidates(const PixelSpan& pixels, GroundFit<kSide>& fit,
                               IsCandidate isCandidate) {
    std::int32_t* HWY_RESTRICT cell = fit.cell.data();
    float* HWY_RESTRICT height_m = fit.z_m.data();
    std::size_t n = fit.candidates;
    forEachVector(pixels.size, [&](auto d, std::size_t pixel) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const auto x = hn::LoadU(d, pixels.x_m + pixel), y = hn::LoadU(d, pixels.y_m + pixel);
        const auto cells = gridCells<kSide>(d, x, y);
        const auto is_candidate =
            hn::And(cells.is_on_grid, isCandidate(d, pixel, x, y, cells.cell));
        // Writes whole vectors; the next vector overwrites the surplus. Masked stores are slow on
        // some machines.
        auto heights_m = hn::LoadU(d, pixels.z_m + pixel);
        auto place = cells.cell;
        const std::size_t listed = compress(d, is_candidate, heights_m, place);
        hn::StoreU(heights_m, d, height_m + n);
        hn::StoreU(place, di, cell + n);
        n += listed;
    });
    fit.candidates = n;
}

// The next two functions are not inlined, because only returning from a function clears the upper
// halves of vectors, which would slow down the scalar loops of the fit.

template <int kSide>
HWY_NOINLINE void listMarked(const PixelSpan& pixels, const std::uint8_t* HWY_RESTRICT mark,
                             std::uint8_t wanted, GroundFit<kSide>& fit) {
    listCandidates(pixels, fit, [&](auto d, std::size_t pixel, auto, auto, auto) HAGEN_INLINE {
        const hn::RebindToSigned<decltype(d)> di;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto marks = hn::PromoteTo(di, hn::LoadU(d8, mark + pixel));
        return hn::RebindMask(d, hn::Eq(marks, hn::Set(di, wanted)));
    });
}

/// Lists the pixels close to a coarse surface with one height per cell; the tolerance grows with
/// distance. This gathers one height per pixel; interpolation would take four.
template <int kSide>
HWY_NOINLINE void listClose(const PixelSpan& pixels, const float* HWY_RESTRICT coarse_m,
                            GroundFit<kSide>& fit) {
    listCandidates(
        pixels, fit, [&](auto d, std::size_t pixel, auto x, auto y, auto cell) HAGEN_INLINE {
            const auto z = hn::LoadU(d, pixels.z_m + pixel);
            const auto h_m = hn::Sub(z, hn::GatherIndex(d, coarse_m, cell));
            const auto distance_m = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
            const auto min_m =
                hn::Sub(hn::Set(d, -kClose_m), hn::Mul(hn::Set(d, kCloseBelow_per_m), distance_m));
            const auto max_m =
                hn::Add(hn::Set(d, kClose_m), hn::Mul(hn::Set(d, kCloseAbove_per_m), distance_m));
            return hn::And(hn::Gt(h_m, min_m), hn::Lt(h_m, max_m));
        });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
