#pragma once
#include <hagen/segmentation/CellTops.h>

namespace hagen {

/// Raises the tolerance over crops. Plants that stand 0.1 to 1 m high in 35 % of all cells (0.75
/// m) that were seen within 18 m around are a canopy, which one flies over as over the ground: the
/// bushes, hedges and cars of a street fill a smaller part of what is seen. In a canopy a return is
/// an obstacle only where it is higher than the plants: the mean + 2 standard deviations of the
/// cells' highest returns, + 0.1 m. Shares and means are those of 13 x 13 blocks of 4 x 4 cells;
/// where fewer than 30 of these cells were seen, there is no telling, and no canopy.
/// `height_m` above the surface, and the tops of the same; NaN where a pixel is empty.
void tolerateCanopy(const CellTops& tops, const Image<float>& height_m, Image<float>& tolerance_m);

}  // namespace hagen
