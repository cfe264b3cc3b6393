#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/PixelCells.h>
#include <hagen/scan/Image.h>
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
    CellArea area;              ///< the cells that were computed
};

/// `height_m` above the surface.
void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops,
                  const CellArea& area = {});

/// Raises `highest_m` of the cell of each pixel to what is known of it from an earlier call, in
/// which the cell had more pixels. `known_m` is per pixel, NaN where nothing is known.
void raiseHighest(const PixelCells& cells, const Image<float>& known_m, CellTops& tops);

/// The highest of the pixels in a cell (PixelCells::cell), for a later raiseHighest(); NaN if it
/// was not computed. What was raised does not count: else, a height could outlast what had it.
float highestOf(const CellTops& tops, int cell);

}  // namespace hagen
