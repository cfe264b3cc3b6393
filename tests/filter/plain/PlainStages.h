// Plain definitions of the ground stages: they define what libs/filter/simd computes. The headers
// of the stages document them. Both add floats in the same order, so results are bit-identical.
#pragma once
#include <hagen/filter/CellTops.h>
#include <hagen/filter/GroundSurface.h>
#include <hagen/filter/PixelCells.h>
#include <hagen/filter/PixelPoints.h>
#include <cstdint>
#include <vector>
#include "filter/simd/GroundFrame.h"
#include "filter/simd/HeightLabels.h"

namespace hagen::plain {

Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude,
                                 const std::vector<std::int32_t>& columns);
void findPixelCells(const PixelPoints& pixels, PixelCells& cells);
void findLevelPixels(const PixelPoints& pixels, const PixelCells& cells,
                     Image<std::uint8_t>& is_level);
void fitGroundSurface(const PixelPoints& pixels, const Image<bool>& is_candidate,
                      GroundSurface& surface);
void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      const std::vector<std::int32_t>& columns, GroundSurface& surface);
void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m);
void findCellTops(const PixelCells& cells, const Image<float>& height_m, CellTops& tops);
void toleratedHeights(const PixelPoints& pixels, const PixelCells& cells, const CellTops& tops,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m);
void tolerateCanopy(const PixelCells& cells, const CellTops& tops, float sensor_height_m,
                    Image<float>& tolerance_m);
void requireEvidence(const PixelPoints& pixels, const PixelCells& cells,
                     const Image<float>& height_m, const Image<std::uint8_t>& is_level,
                     float sensor_height_m, Image<float>& tolerance_m,
                     std::vector<std::uint8_t>& has_evidence);
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels);
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels);

}  // namespace hagen::plain
