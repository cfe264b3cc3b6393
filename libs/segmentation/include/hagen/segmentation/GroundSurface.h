#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/GroundFit.h>
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hagen {

/// The height of the ground over a square around the sensor, in the ground's frame.
struct GroundSurface {
    static constexpr float kCell_m = 0.75f;
    static constexpr int kCells = 128;  ///< along each side: 48 m to each of the four

    /// kCells x kCells: height at the centre of cell (i, j), where x = (i + 0.5) kCell_m - 48 m, y
    /// likewise.
    Eigen::ArrayXXf height_m;

    /// Bilinear between the cells' centres; beyond the square the height at its edge.
    float at(float x_m, float y_m) const;
};

/// The memory of fitGroundSurface(). Keep it from scan to scan, so that none is allocated; it
/// carries nothing over.
struct GroundSurfaceWorkspace {
    GroundFit<GroundSurface::kCells> fine;
    GroundFit<GroundSurface::kCells / 2> coarse;
    std::vector<float> coarse_m;  ///< the coarse surface on the fine grid
};

/// Fits the surface to the pixels that `is_candidate`, in the ground's frame, in these steps:
///  1. the lowest candidate of each cell; where three or more neighbours are 0.4 m higher, the
///     lowest of all neighbours (mirror images and stray returns lie below the ground; two adjacent
///     strays protect each other);
///  2. cells whose lowest candidate stands more than 0.15 m above what slopes allow from the lower
///     ones are not ground: 0.3 over cells with candidates, 0.17 over others (against the plane);
///  3. a cell's height is the mean of its candidates close to the lowest, its weight grows with
///     their number;
///  4. one smoothing by a weighted 3 x 3 binomial, then cells without candidates are filled from
///     coarser and coarser grids (pull-push: Gortler et al., The Lumigraph, 1996).
/// No candidate at all: the plane z = 0.
void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface, GroundSurfaceWorkspace& work);

/// The surface under a labelled image, in two fits. The first is coarse, on cells twice as wide, to
/// the ROU of 200 to 400 columns. It tells which pixels can be ground: all that are close to its
/// height at the centre of their cell, whatever their labels, which brings back what the labels cut
/// off. The surface is then fitted to these by steps 3 and 4; strays and obstacles are not close.
void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels, GroundSurface& surface,
                      GroundSurfaceWorkspace& work);

/// Each pixel's height above the surface; NaN where it is empty.
void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m);

/// The same for any points; height_m has room for all.
void heightsAbove(const GroundSurface& surface, std::size_t points, const float* x_m,
                  const float* y_m, const float* z_m, float* height_m);

}  // namespace hagen
