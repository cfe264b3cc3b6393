#pragma once
#include <hagen/segmentation/CellTops.h>

namespace hagen {

/// The memory of tolerateCanopy(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over.
struct CanopyWorkspace {
    Eigen::ArrayXXf canopy_m;  ///< the height of the canopy in each cell of CellTops, 0 for none
};

/// Raises the tolerance over crops. Where plants 0.1 to 1 m high stand in 35 % of all cells (0.75
/// m) seen within 18 m, they are a canopy, which is flown over like the ground: bushes, hedges and
/// cars of a street fill a smaller share. In a canopy a return is an obstacle only if it is higher
/// than the plants: the mean + 2 standard deviations of the cells' highest returns, + 0.1 m. Shares
/// and means are over 13 x 13 blocks of 4 x 4 cells; where fewer than 30 of these cells were seen,
/// no canopy is assumed. `height_m` above the surface, and `tops` of the same; NaN where a pixel is
/// empty.
void tolerateCanopy(const CellTops& tops, const Image<float>& height_m, Image<float>& tolerance_m,
                    CanopyWorkspace& work);

}  // namespace hagen
