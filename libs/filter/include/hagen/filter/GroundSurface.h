#pragma once
#include <hagen/filter/GroundFit.h>
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hagen {

/// The height of the ground over a square around the sensor, in the ground frame.
struct GroundSurface {
    static constexpr float kCell_m = 0.75f;
    static constexpr int kCells = 128;  ///< cells per side, 48 m in each direction

    /// kCells x kCells heights at the cell centres: x = (i + 0.5) kCell_m - 48 m, y likewise with
    /// j.
    Eigen::ArrayXXf height_m;

    /// Bilinear interpolation between cell centres; outside the square, the height at its edge.
    float at(float x_m, float y_m) const;
};

/// Workspace of fitGroundSurface(). Reuse it between scans to avoid allocations; it has no state.
struct GroundSurfaceWorkspace {
    GroundFit<GroundSurface::kCells> fine;
    GroundFit<GroundSurface::kCells / 2> coarse;
    std::vector<std::int32_t> columns;
    std::vector<float> coarse_m;  ///< the coarse surface on the fine grid
};

/// Fits the surface to the pixels marked in `is_candidate`, in the ground frame:
///  1. take the lowest candidate of each cell; if three or more neighbours are 0.4 m higher, the
///     lowest of all neighbours (mirror images and stray returns lie below the ground; two adjacent
///     strays protect each other);
///  2. remove cells whose lowest candidate is more than 0.15 m above the slopes from lower cells:
///     0.3 over cells with candidates, 0.15 over others (relative to the plane);
///  3. average the candidates close to the lowest candidate of each cell, weighted by their number;
///  4. smooth with a weighted 3 x 3 binomial, then fill cells without candidates from increasingly
///     coarse grids (pull-push: Gortler et al., The Lumigraph, 1996).
/// Without candidates, the result is the plane z = 0.
void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface, GroundSurfaceWorkspace& work);

/// Fits the surface under a labelled image in two passes. The first is coarse (cells twice as wide)
/// and uses the ROU of 200 to 400 evenly spaced columns, or of `columns`. Pixels close to its
/// height at the centre of their cell may be ground, whatever their labels; this recovers ground
/// that the labels have cut off. Steps 3 and 4 then fit the surface to these pixels, which do not
/// include strays and obstacles.
void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels, GroundSurface& surface,
                      GroundSurfaceWorkspace& work,
                      const std::vector<std::int32_t>* columns = nullptr);

/// Computes each pixel's height above the surface; NaN if it is empty.
void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m);

/// Like above, but for a list of points; height_m must have room for all of them.
void heightsAbove(const GroundSurface& surface, std::size_t points, const float* x_m,
                  const float* y_m, const float* z_m, float* height_m);

}  // namespace hagen
