#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/RangeImage.h>
#include <hagen/range_image/Scan.h>
#include <hagen/segmentation/Ground.h>
#include <vector>

namespace hagen {

/// A pixel may hold several returns, and its label is that of the closest. One that lies more than
/// 0.3 m behind it is judged by its own height above the ground: RoI where that exceeds the pixel's
/// tolerance, ROU else. All others get Unclassified, which is to say: as their pixel.
void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         std::vector<Label>& own_label);

}  // namespace hagen
