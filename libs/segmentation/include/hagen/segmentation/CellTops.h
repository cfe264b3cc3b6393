#pragma once
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace hagen {

/// The highest point in each cell of the ground. The cells are those of GroundSurface, with a
/// border of one cell all around, which holds all points beyond.
struct CellTops {
    static constexpr float kNone_m = -std::numeric_limits<float>::infinity();

    Image<std::int32_t> cell;  ///< of each pixel, as an index into top_m; 0 where it is empty
    Eigen::ArrayXXf top_m;     ///< height above the surface; kNone_m where there is no pixel
};

/// `pixels` in the ground's frame, `height_m` above the surface.
void findCellTops(const PixelPoints& pixels, const Image<float>& height_m, CellTops& tops);

}  // namespace hagen
