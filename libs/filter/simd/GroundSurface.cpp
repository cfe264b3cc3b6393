#include <hagen/filter/GroundSurface.h>
#include <algorithm>
#include <vector>

// Compiled once per instruction set: Highway includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/simd/GroundSurface.cpp"
#include <hwy/foreach_target.h>
// One file per step:
#include "filter/simd/CellMeans-inl.h"
#include "filter/simd/GroundCandidates-inl.h"
#include "filter/simd/LowestCandidates-inl.h"
#include "filter/simd/ObstacleRemoval-inl.h"
#include "filter/simd/PullPush-inl.h"

// Fast because the first fit, which only selects nearby pixels, is coarse. The second fit visits
// each pixel in two short loops, for the minimum and the mean of its cell; all other work is on
// whole vectors of cells.

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace {

constexpr int kCells = GroundSurface::kCells, kCoarseCells = kCells / 2;

/// Runs all steps for the listed candidates; steps 1 and 2 only if kCleans.
template <int kSide, bool kCleans>
HWY_INLINE void fitSurface(GroundFit<kSide>& fit, float* HWY_RESTRICT surface_m, int stride) {
    findLowest(fit);
    if constexpr (kCleans) {
        removeStrays<kSide>(fit.lowest_m, fit.cleaned_m);
        removeObstacles(fit);
    }
    sumUpClose(fit, (kCleans ? fit.cleaned_m : fit.lowest_m).data());
    weighMeans(fit);
    smoothHeights<kSide>(fit.sum_m, fit.number, fit.pyramid.front());
    fillHeights(fit.pyramid, surface_m, stride);
}

/// Fits the surface to the pixels marked `true`.
void FitMarkedIn(const PixelSpan& image, const std::uint8_t* mark, GroundFit<kCells>& fit,
                 float* HWY_RESTRICT surface_m) {
    listMarked(image, mark, true, fit);
    fitSurface<kCells, true>(fit, surface_m, kCells);
}

/// Fits the surface to the ROU of some columns. Writes heights at the cell centres of the fine
/// grid.
void FitCoarseIn(const PixelSpan& image, std::size_t rows, const std::vector<std::int32_t>& columns,
                 const std::uint8_t* labels, GroundFit<kCoarseCells>& fit,
                 float* HWY_RESTRICT fine_m) {
    for (const std::int32_t column : columns) {
        const std::size_t first = static_cast<std::size_t>(column) * rows;
        listMarked(image.part(first, rows), labels + first, static_cast<std::uint8_t>(Label::Rou),
                   fit);
    }
    HeightGrid& coarse = fit.pyramid.front();
    fitSurface<kCoarseCells, true>(fit, coarse.height_m.data() + coarse.column(0),
                                   kStride<kCoarseCells>);
    extendColumns(coarse);
    for (int j = 0; j < kCells; ++j) {
        refineColumn(hn::CappedTag<float, 16>(), coarse, j, fine_m + gridColumn(j));
    }
}

/// Fits the surface to the pixels close to a coarse surface.
void FitCloseIn(const PixelSpan& image, const float* HWY_RESTRICT coarse_m, GroundFit<kCells>& fit,
                float* HWY_RESTRICT surface_m) {
    listClose(image, coarse_m, fit);
    fitSurface<kCells, false>(fit, surface_m, kCells);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "filter/SampleColumns.h"

namespace hagen {
namespace {

HWY_EXPORT(FitMarkedIn);
HWY_EXPORT(FitCoarseIn);
HWY_EXPORT(FitCloseIn);

constexpr int kCells = GroundSurface::kCells;

/// Prepares the candidate list for this many pixels, with room for whole vectors. Allocates the
/// grids on the first fit.
template <int kSide>
void beginFit(std::size_t pixels, GroundFit<kSide>& fit) {
    constexpr std::size_t kMaxWidth = 64;
    fit.candidates = 0;
    if (fit.cell.size() < pixels + kMaxWidth) {
        fit.cell.resize(pixels + kMaxWidth);
        fit.z_m.resize(pixels + kMaxWidth);
    }
    if (!fit.pyramid.empty()) return;
    for (auto* heights_m : {&fit.lowest_m, &fit.cleaned_m, &fit.envelope_m, &fit.ramp_m}) {
        heights_m->assign(GroundFit<kSide>::kSize, kNoHeight);
    }
    for (auto* sums : {&fit.sum_m, &fit.number}) sums->assign(GroundFit<kSide>::kSize, 0.0f);
    for (int cells = kSide; cells >= 1; cells /= 2) {
        const std::vector<float> zero((cells + 2) * (cells + 2), 0.0f);
        fit.pyramid.push_back({cells, zero, zero, zero});
    }
}

PixelSpan spanOf(const PixelPoints& pixels) {
    return {pixels.x_m.data(), pixels.y_m.data(), pixels.z_m.data(),
            static_cast<std::size_t>(pixels.x_m.size())};
}

/// Fits a coarse surface under the ROU of a few columns; stores it in work.coarse_m.
void fitCoarse(const PixelSpan& image, const Image<Label>& labels,
               const std::vector<std::int32_t>& columns, GroundSurfaceWorkspace& work) {
    beginFit(image.size, work.coarse);
    work.coarse_m.resize(kGridSize);
    HWY_DYNAMIC_DISPATCH(FitCoarseIn)
    (image, static_cast<std::size_t>(labels.rows()), columns,
     reinterpret_cast<const std::uint8_t*>(labels.data()), work.coarse, work.coarse_m.data());
}

}  // namespace

void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface, GroundSurfaceWorkspace& work) {
    static_assert(sizeof(bool) == 1);
    const PixelSpan image = spanOf(pixels);
    beginFit(image.size, work.fine);
    surface.height_m.resize(kCells, kCells);
    HWY_DYNAMIC_DISPATCH(FitMarkedIn)
    (image, reinterpret_cast<const std::uint8_t*>(is_candidate.data()), work.fine,
     surface.height_m.data());
}

void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels, GroundSurface& surface,
                      GroundSurfaceWorkspace& work, const std::vector<std::int32_t>* columns) {
    const PixelSpan image = spanOf(pixels);
    if (columns == nullptr) {
        sampleColumns(labels.cols(), kEnoughColumns, work.columns);
        columns = &work.columns;
    }
    fitCoarse(image, labels, *columns, work);
    beginFit(image.size, work.fine);
    surface.height_m.resize(kCells, kCells);
    HWY_DYNAMIC_DISPATCH(FitCloseIn)
    (image, work.coarse_m.data(), work.fine, surface.height_m.data());
}

}  // namespace hagen
#endif
