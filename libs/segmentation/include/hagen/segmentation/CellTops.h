#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/segmentation/CellArea.h>
#include <hagen/segmentation/PixelCells.h>
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace hagen {

/// How high objects stand in each ground cell: the second-highest point up to 1.5 m above the
/// surface, or the only one. One return alone may be rain, dust or a mixed pixel, and what is
/// higher may be the crown of a tree that stands elsewhere. Indexed by PixelCells::cell.
struct CellTops {
    static constexpr float kNone_m = -std::numeric_limits<float>::infinity();

    Eigen::ArrayXXf top_m;      ///< height above the surface; kNone_m in cells without pixels
    Eigen::ArrayXXf highest_m;  ///< the highest up to 1.5 m, likewise
    std::vector<float> two_m;   ///< the highest two of each cell, side by side (workspace)
};

/// `height_m` above the surface.
void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops,
                  const CellArea& area = {});

}  // namespace hagen
