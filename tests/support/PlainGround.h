#pragma once
#include <hagen/filter/GroundFrame.h>
#include <hagen/filter/GroundSurface.h>
#include <hagen/filter/HeightLabels.h>
#include <hagen/filter/PixelPoints.h>

/// Simple reference implementations of the ground stages, pixel by pixel and cell by cell, to
/// compare the fast ones with.
namespace hagen::test::plain {

void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels);
Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude);
void fitGroundSurface(const PixelPoints& pixels, const Image<Label>& labels,
                      GroundSurface& surface);
void findLevelPixels(const PixelPoints& pixels, Image<std::uint8_t>& is_level);
void keepLevelRou(const Image<Label>& labels, const Image<std::uint8_t>& is_level,
                  Image<Label>& candidates);
void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m);
void toleratedHeights(const PixelPoints& pixels, const Image<float>& height_m,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m);
void tolerateCanopy(const PixelPoints& pixels, const Image<float>& height_m,
                    Image<float>& tolerance_m);
void requireEvidence(const PixelPoints& pixels, const Image<float>& height_m,
                     const Image<std::uint8_t>& is_level, Image<float>& tolerance_m);
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels);
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels);

}  // namespace hagen::test::plain
