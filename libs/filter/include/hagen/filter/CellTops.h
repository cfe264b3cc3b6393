#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/PixelCells.h>
#include <hagen/scan/Image.h>
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace hagen {

/// Height of the objects in each ground cell: the second-highest point up to 1.5 m above the
/// surface, or the highest if there is no other. A single return may be rain, dust or a mixed
/// pixel, and higher points may belong to an overhanging tree crown. Indexed by PixelCells::cell.
struct CellTops {
    static constexpr float kNone_m = -std::numeric_limits<float>::infinity();

    Eigen::ArrayXXf top_m;      ///< height above the surface; kNone_m in cells without pixels
    Eigen::ArrayXXf highest_m;  ///< highest point up to 1.5 m; kNone_m in cells without pixels
    std::vector<float> two_m;   ///< two highest points of each cell, interleaved (workspace)
    CellArea area;              ///< the cells that were computed
};

/// `height_m` contains heights above the surface.
void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops,
                  const CellArea& area = {});

/// Raises `highest_m` of each pixel's cell to a height from an earlier call, in which the cell had
/// more pixels. `known_m` is per pixel, NaN if unknown.
void raiseHighest(const PixelCells& cells, const Image<float>& known_m, CellTops& tops);

/// The height of the highest pixel in a cell (PixelCells::cell), for a later raiseHighest(); NaN if
/// not computed. Ignores raised heights, so that a height does not outlast its object.
float highestOf(const CellTops& tops, int cell);

}  // namespace hagen
