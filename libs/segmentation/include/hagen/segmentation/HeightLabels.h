#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/CellTops.h>
#include <hagen/segmentation/PixelPoints.h>

namespace hagen {

/// How high above the ground a return may be and still be ground.
struct HeightTolerance {
    float near_m = 0.17f;       ///< beside the sensor
    float per_m = 0.005f;       ///< more, a metre of distance
    float beside_tall = 0.12f;  ///< less, a metre that what stands there is tall (1.1 at most)
};

/// The tolerance of each pixel, at least 0.04 m; NaN where it is empty. It is less where something
/// tall stands in the same cell of 0.75 m or in one beside it: there, what is a little above the
/// ground is the foot of an obstacle rather than grass.
/// `pixels` in the ground's frame, `tops` of their heights above the surface.
void toleratedHeights(const PixelPoints& pixels, const CellTops& tops,
                      const HeightTolerance& tolerance, Image<float>& tolerance_m);

/// RoI where a pixel is higher than its tolerance, ROU else; Unclassified where it is empty.
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);

/// Follows each obstacle down to its foot: below a RoI pixel, what is not level with the ground
/// (0.015 m) and leads up to it more steeply than 45 degrees is RoI too. Up to three empty pixels,
/// which are Unclassified, may lie between the two. `pixels` in the ground's frame.
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels);

/// One vote of each pixel's 8 neighbours, and the pixel itself, where its height is within 0.2 m of
/// the tolerance: a lone speck follows the majority. Neighbours whose distance along the ground
/// differs by more than 1 m (both to the nearest 1/64 m, and 511 m at most) have no vote. What is
/// clearly higher stays: a wire is a speck too.
/// Fewer than 3 votes, or a draw: nothing changes. Votes are the labels as they were handed in.
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels);

}  // namespace hagen
