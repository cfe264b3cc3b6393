#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/CellTops.h>
#include <hagen/filter/PixelCells.h>

namespace hagen {

/// Raises the tolerance over crops. If plants 0.1 to 1 m high stand in 35 % of all cells (0.75 m)
/// seen within 18 m, they are a canopy, which is flown over like the ground. Bushes, hedges and
/// cars in a street cover less. If more than 20 % of these cells are higher, there is no canopy: in
/// a room, desks are as high as crops, but walls stand around them. In a canopy a return is an
/// obstacle only if it is higher than the plants: the mean + 2 standard deviations of the cells'
/// highest returns, but not more than twice the mean (short grass with trunks in it is no high
/// crop), + 0.1 m. No cell has a canopy in which two returns are more than another 0.1 m higher:
/// what stands out of the plants stands on the ground. These statistics are over 13 x 13 blocks of
/// 4 x 4 cells; if fewer than 30 of the cells were seen, no canopy is assumed. `tops` are relative
/// to the surface; tolerances of empty pixels are NaN. `area` is that of `tops`: only pixels that
/// are kCanopyReach inside it see all of their canopy.
void tolerateCanopy(const PixelCells& cells, const CellTops& tops, Image<float>& tolerance_m,
                    const CellArea& area = {});

constexpr int kCanopyReach = 28;  // cells: 6 blocks of 4, and the rest of the pixel's own

}  // namespace hagen
