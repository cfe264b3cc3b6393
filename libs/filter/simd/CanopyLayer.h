#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/CellTops.h>
#include <hagen/filter/PixelCells.h>

namespace hagen {

/// Raises the tolerance over crops. If plants 0.1 to 1 m high cover 35 % of all cells (0.75 m) seen
/// within 18 m, they are a canopy, which is treated like ground. Bushes, hedges and cars in a
/// street cover less. If more than 20 % of these cells are higher, there is no canopy: in a room,
/// desks are as high as crops, but surrounded by walls. Plants are at most three times as high as
/// the sensor: a standing drone sees only the lower part of trunks. In a canopy, only returns above
/// the plants are obstacles; the limit is the mean + 2 standard deviations of the cells' highest
/// returns, capped at twice the mean (short grass with trunks is not a high crop), + 0.1 m. A cell
/// with two returns more than another 0.1 m higher is not raised, because its object stands on the
/// ground. These statistics are over 13 x 13 blocks of 4 x 4 cells; with fewer than 30 observed
/// cells, no canopy is assumed. `tops` are relative to the surface; tolerances of empty pixels are
/// NaN. `area` is the area of `tops`; only pixels at least kCanopyReach inside it get a complete
/// result.
void tolerateCanopy(const PixelCells& cells, const CellTops& tops, float sensor_height_m,
                    Image<float>& tolerance_m, const CellArea& area = {});

constexpr int kCanopyReach = 28;  // cells: 6 blocks of 4 and the rest of the pixel's own block

}  // namespace hagen
