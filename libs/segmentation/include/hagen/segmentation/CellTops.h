#pragma once
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace hagen {

/// How high objects stand in each ground cell: the second-highest point up to 1.5 m above the
/// surface, or the only one. One return alone may be rain, dust or a mixed pixel, and what is
/// higher may be the crown of a tree that stands elsewhere. The cells are those of GroundSurface
/// plus a border of one cell on all sides for all points beyond.
struct CellTops {
    static constexpr float kNone_m = -std::numeric_limits<float>::infinity();

    Image<std::int32_t> cell;   ///< of each pixel, as an index into top_m; 0 if it is empty
    Eigen::ArrayXXf top_m;      ///< height above the surface; kNone_m in cells without pixels
    Eigen::ArrayXXf highest_m;  ///< the highest up to 1.5 m, likewise
};

/// `pixels` in the ground frame, `height_m` above the surface.
void findCellTops(const PixelPoints& pixels, const Image<float>& height_m, CellTops& tops);

}  // namespace hagen
