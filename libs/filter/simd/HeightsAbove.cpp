#include <hagen/filter/GroundSurface.h>
#include <algorithm>
#include <cstring>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/HeightsAbove.cpp"
#include <hwy/foreach_target.h>
#include "filter/simd/GroundGrid-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

constexpr int kCells = GroundSurface::kCells;

/// Points relative to the centres of cells, and the heights at the four centres around each.
struct Corners {
    static constexpr std::size_t kPoints = 256;
    HWY_ALIGN std::int32_t cell[kPoints];
    HWY_ALIGN float to_next_i[kPoints], to_next_j[kPoints];
    HWY_ALIGN float here_m[2 * kPoints];  ///< heights of cells (i, j) and (i + 1, j)
    HWY_ALIGN float next_m[2 * kPoints];  ///< heights of cells (i, j + 1) and (i + 1, j + 1)
};

/// Bilinear interpolation. Copies heights in pairs, because gather instructions are slower, and for
/// a few hundred points in advance, because reading a vector right after writing its parts stalls.
void HeightsAboveIn(std::size_t points, const float* HWY_RESTRICT x_m,
                    const float* HWY_RESTRICT y_m, const float* HWY_RESTRICT z_m,
                    const float* HWY_RESTRICT surface_m, float* HWY_RESTRICT height_m) {
    Corners at;
    for (std::size_t first = 0; first < points; first += Corners::kPoints) {
        const std::size_t size = std::min(Corners::kPoints, points - first);
        forEachVector(size, [&](auto d, std::size_t k) HAGEN_INLINE {
            const hn::RebindToSigned<decltype(d)> di;
            const auto cells = [&](auto coordinate_m) HAGEN_INLINE {
                const auto c =
                    hn::Add(hn::Mul(coordinate_m, hn::Set(d, 1 / GroundSurface::kCell_m)),
                            hn::Set(d, 0.5f * kCells - 0.5f));
                const auto positive = hn::IfThenElseZero(hn::Gt(c, hn::Zero(d)), c);  // 0 for NaN
                return hn::Min(positive, hn::Set(d, kCells - 1));
            };
            const auto u = cells(hn::LoadU(d, x_m + first + k));
            const auto v = cells(hn::LoadU(d, y_m + first + k));
            const auto i = hn::Min(hn::ConvertTo(di, u), hn::Set(di, kCells - 2));
            const auto j = hn::Min(hn::ConvertTo(di, v), hn::Set(di, kCells - 2));
            static_assert(kCells == 1 << 7);
            hn::StoreU(hn::Add(hn::ShiftLeft<7>(j), i), di, at.cell + k);
            hn::StoreU(hn::Sub(u, hn::ConvertTo(d, i)), d, at.to_next_i + k);
            hn::StoreU(hn::Sub(v, hn::ConvertTo(d, j)), d, at.to_next_j + k);
        });
        for (std::size_t k = 0; k < size; ++k) {
            const float* HWY_RESTRICT corner_m = surface_m + at.cell[k];
            std::memcpy(at.here_m + 2 * k, corner_m, 2 * sizeof(float));
            std::memcpy(at.next_m + 2 * k, corner_m + kCells, 2 * sizeof(float));
        }
        forEachVector(size, [&](auto d, std::size_t k) HAGEN_INLINE {
            using VD = hn::Vec<decltype(d)>;
            const VD to_next_i = hn::LoadU(d, at.to_next_i + k);
            const VD to_next_j = hn::LoadU(d, at.to_next_j + k);
            VD here_m, here_next_i_m, next_j_m, next_ij_m;
            hn::LoadInterleaved2(d, at.here_m + 2 * k, here_m, here_next_i_m);
            hn::LoadInterleaved2(d, at.next_m + 2 * k, next_j_m, next_ij_m);
            const auto between = [](VD from, VD to, VD part) HAGEN_INLINE {
                return hn::Add(from, hn::Mul(part, hn::Sub(to, from)));
            };
            const VD ground_m = between(between(here_m, next_j_m, to_next_j),
                                        between(here_next_i_m, next_ij_m, to_next_j), to_next_i);
            hn::StoreU(hn::Sub(hn::LoadU(d, z_m + first + k), ground_m), d, height_m + first + k);
        });
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(HeightsAboveIn);

}  // namespace

void heightsAbove(const GroundSurface& surface, std::size_t points, const float* x_m,
                  const float* y_m, const float* z_m, float* height_m) {
    HWY_DYNAMIC_DISPATCH(HeightsAboveIn)
    (points, x_m, y_m, z_m, surface.height_m.data(), height_m);
}

}  // namespace hagen
#endif
