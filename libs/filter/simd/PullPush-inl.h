// Step 4 of the ground surface fit: weighted 3 x 3 binomial smoothing, then filling cells without
// candidates from increasingly coarse grids (pull-push: Gortler et al., The Lumigraph, 1996). For
// files that Highway compiles once per instruction set.
#ifndef HAGEN_PULL_PUSH
#define HAGEN_PULL_PUSH
#include <hagen/filter/GroundFit.h>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace hagen {
namespace {

/// Copies the heights at both ends of each column to the border.
inline void extendColumns(HeightGrid& grid) {
    for (int j = 0; j < grid.cells; ++j) {
        float* const column_m = grid.height_m.data() + grid.column(j);
        column_m[-1] = column_m[0];
        column_m[grid.cells] = column_m[grid.cells - 1];
    }
}

}  // namespace
}  // namespace hagen
#endif

#if defined(HAGEN_PULL_PUSH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAGEN_PULL_PUSH_INL
#undef HAGEN_PULL_PUSH_INL
#else
#define HAGEN_PULL_PUSH_INL
#endif

#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

/// The 3 x 3 binomial around a cell.
template <int kSide>
HWY_INLINE hn::Vec<hn::ScalableTag<float>> binomial(const float* HWY_RESTRICT cell) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto bothSides = [&](int step) HAGEN_INLINE {
        return hn::Add(hn::LoadU(d, cell - step), hn::LoadU(d, cell + step));
    };
    const V sides = hn::Add(bothSides(1), bothSides(kStride<kSide>));
    const V corners = hn::Add(bothSides(kStride<kSide> - 1), bothSides(kStride<kSide> + 1));
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(d, 0.25f), hn::LoadU(d, cell)), hn::Mul(hn::Set(d, 0.125f), sides)),
        hn::Mul(hn::Set(d, 0.0625f), corners));
}

template <int kSide>
void smoothHeights(const std::vector<float>& weighted_m, const std::vector<float>& weights,
                   HeightGrid& smooth) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; i += static_cast<int>(hn::Lanes(d))) {
            const int cell = gridColumn<kSide>(j) + i;
            const V weight = binomial<kSide>(weights.data() + cell);
            hn::StoreU(weight, d, smooth.weight.data() + cell);
            const bool is_empty = hn::AllTrue(d, hn::Eq(weight, hn::Zero(d)));  // usually true
            const V smooth_m = is_empty ? hn::Zero(d) : binomial<kSide>(weighted_m.data() + cell);
            hn::StoreU(smooth_m, d, smooth.weighted_m.data() + cell);
        }
    }
}

/// Pull: each coarse cell is the weighted mean of the four cells it covers. `d` has at most as many
/// lanes as a column has coarse cells.
template <class D>
HWY_INLINE void pull(D d, const HeightGrid& fine, HeightGrid& coarse) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN float across[kGridStride + 64];  // sums over two columns
    const VD one = hn::Set(d, 1.0f);
    for (int j = 0; j < coarse.cells; ++j) {
        const int left = fine.column(2 * j), right = fine.column(2 * j + 1);
        const auto sumAcross = [&](const std::vector<float>& values) HAGEN_INLINE {
            for (int i = 0; i < fine.cells; i += lanes) {
                hn::StoreU(hn::Add(hn::LoadU(d, values.data() + left + i),
                                   hn::LoadU(d, values.data() + right + i)),
                           d, across + i);
            }
        };
        const auto sumAlong = [&](int i) HAGEN_INLINE {
            VD even, odd;
            hn::LoadInterleaved2(d, across + 2 * i, even, odd);
            return hn::Add(even, odd);
        };
        float* HWY_RESTRICT weighted_m = coarse.weighted_m.data() + coarse.column(j);
        float* HWY_RESTRICT weight = coarse.weight.data() + coarse.column(j);
        sumAcross(fine.weighted_m);
        for (int i = 0; i < coarse.cells; i += lanes) hn::StoreU(sumAlong(i), d, weighted_m + i);
        sumAcross(fine.weight);
        for (int i = 0; i < coarse.cells; i += lanes) {
            const VD weights = sumAlong(i);
            hn::StoreU(hn::Div(hn::LoadU(d, weighted_m + i), hn::Max(weights, one)), d,
                       weighted_m + i);
            hn::StoreU(hn::Min(weights, one), d, weight + i);
        }
    }
}

/// Column j of a grid twice as fine, by bilinear interpolation between coarse cell centres: along
/// each axis, 3/4 of the coarse cell around a fine cell and 1/4 of the next coarse cell.
template <class D>
HWY_INLINE void refineColumn(D d, const HeightGrid& coarse, int j, float* HWY_RESTRICT fine_m) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d)), last = coarse.cells - 1;
    const VD near = hn::Set(d, 0.75f), far = hn::Set(d, 0.25f);
    const int own = j / 2, next = std::clamp(j % 2 == 0 ? own - 1 : own + 1, 0, last);
    const float* HWY_RESTRICT own_m = coarse.height_m.data() + coarse.column(own);
    const float* HWY_RESTRICT next_m = coarse.height_m.data() + coarse.column(next);
    for (int i = 0; i < coarse.cells; i += lanes) {
        const auto betweenColumns = [&](int cell) HAGEN_INLINE {
            return hn::Add(hn::Mul(near, hn::LoadU(d, own_m + cell)),
                           hn::Mul(far, hn::LoadU(d, next_m + cell)));
        };
        const VD mostly = hn::Mul(near, betweenColumns(i));
        const VD even_m = hn::Add(mostly, hn::Mul(far, betweenColumns(i - 1)));
        const VD odd_m = hn::Add(mostly, hn::Mul(far, betweenColumns(i + 1)));
        hn::StoreInterleaved2(even_m, odd_m, d, fine_m + 2 * i);
    }
}

/// Push: a fine cell takes its missing weight from the coarse grid. Column j of the result goes to
/// filled_m + j * stride.
template <class D>
HWY_INLINE void push(D d, const HeightGrid& coarse, const HeightGrid& fine,
                     float* HWY_RESTRICT filled_m, int stride) {
    using VD = hn::Vec<D>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN float below_m[kGridStride + 64];  // refined heights of the coarse grid
    for (int j = 0; j < fine.cells; ++j) {
        refineColumn(d, coarse, j, below_m);
        const float* HWY_RESTRICT weight = fine.weight.data() + fine.column(j);
        const float* HWY_RESTRICT weighted_m = fine.weighted_m.data() + fine.column(j);
        for (int i = 0; i < fine.cells; i += lanes) {
            const VD lacking = hn::Sub(hn::Set(d, 1.0f), hn::LoadU(d, weight + i));
            hn::StoreU(
                hn::Add(hn::LoadU(d, weighted_m + i), hn::Mul(lacking, hn::LoadU(d, below_m + i))),
                d, filled_m + j * stride + i);
        }
    }
}

/// Calls visit(d) with the widest vectors that fit into a column of this many cells.
template <class Visit>
HWY_INLINE void withVectorsFor(int cells, Visit visit) {
    if (cells >= 16) return visit(hn::CappedTag<float, 16>());
    if (cells >= 4) return visit(hn::CappedTag<float, 4>());
    visit(hn::CappedTag<float, 1>());
}

/// Pulls weighted heights up to a single cell and pushes them down again, so that every cell has a
/// height. Writes the finest grid to `surface_m`, with columns `surface_stride` apart.
void fillHeights(std::vector<HeightGrid>& levels, float* HWY_RESTRICT surface_m,
                 int surface_stride) {
    for (std::size_t k = 1; k < levels.size(); ++k) {
        withVectorsFor(levels[k].cells,
                       [&](auto d) HAGEN_INLINE { pull(d, levels[k - 1], levels[k]); });
    }
    HeightGrid& whole = levels.back();
    const int only = whole.column(0);
    whole.height_m[only] =
        whole.weight[only] > 0 ? whole.weighted_m[only] / whole.weight[only] : 0.0f;
    for (std::size_t k = levels.size() - 1; k > 0; --k) {
        HeightGrid& fine = levels[k - 1];
        extendColumns(levels[k]);
        float* const filled_m = k > 1 ? fine.height_m.data() + fine.column(0) : surface_m;
        const int stride = k > 1 ? fine.cells + 2 : surface_stride;
        withVectorsFor(levels[k].cells,
                       [&](auto d) HAGEN_INLINE { push(d, levels[k], fine, filled_m, stride); });
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();
#endif
