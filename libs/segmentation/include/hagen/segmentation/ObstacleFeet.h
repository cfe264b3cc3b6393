#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/PixelPoints.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The memory of growFeet(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over.
struct FeetWorkspace {
    std::vector<std::int32_t> candidates;  ///< pixels that may be a foot; may be longer
};

/// Extends each obstacle down to its foot: below a RoI pixel, a pixel that is not level with the
/// ground (0.015 m), and from which it rises more steeply than 45 degrees, is RoI too. Up to three
/// empty (Unclassified) pixels may lie between the two. `pixels` in the ground's frame.
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels,
              FeetWorkspace& work);

}  // namespace hagen
