#pragma once
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Workspace of growFeet(). Reuse it between scans to avoid allocations; it has no state.
struct FeetWorkspace {
    std::vector<std::int32_t> candidates;  ///< pixels that may be a foot; may have unused entries
};

/// Extends each obstacle down to its foot: a pixel below a RoI pixel becomes RoI if it is at least
/// 0.015 m above the ground and the slope up to the RoI pixel exceeds 45 degrees. Up to three empty
/// (Unclassified) pixels may lie between the two. `pixels` must be in the ground frame.
void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels,
              FeetWorkspace& work);

}  // namespace hagen
