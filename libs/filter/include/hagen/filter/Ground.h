#pragma once
#include <hagen/filter/CellTops.h>
#include <hagen/filter/GroundSurface.h>
#include <hagen/filter/PixelCells.h>
#include <hagen/filter/PixelPoints.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen {

/// The ground under a scan, beyond the paper. Images are I_h x I_w, NaN for empty pixels.
struct Ground {
    bool is_seen = false;  ///< whether the plane may be ground
    /// Transform from the sensor to the ground frame; z = 0 is the mean ground plane.
    Eigen::Isometry3f from_sensor = Eigen::Isometry3f::Identity();
    PixelPoints pixels;  ///< in the ground frame

    /// Whether a surface was fitted. If not, the members below are from an older scan.
    bool has_surface = false;
    PixelCells cells;              ///< the pixels' cells on the surface grid
    Image<std::uint8_t> is_level;  ///< 1 if the pixel looks like ground (GroundEvidence.h)
    GroundSurface surface;         ///< fitted under the ROU pixels
    Image<float> height_m;         ///< height of each pixel above the surface
    CellTops tops;                 ///< the highest point in each cell
    Image<float> tolerance_m;      ///< pixels up to this height are ground
    /// For each block (PixelCells.h), and for positions beyond the grid: whether the surface there
    /// is ground (requireEvidence()). Empty if not requested.
    std::vector<std::uint8_t> has_evidence;
};

}  // namespace hagen
