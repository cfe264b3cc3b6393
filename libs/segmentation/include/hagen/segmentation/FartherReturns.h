#pragma once
#include <hagen/range_image/RangeImage.h>
#include <hagen/range_image/Scan.h>
#include <hagen/segmentation/Clearance.h>
#include <hagen/segmentation/Ground.h>
#include <hagen/segmentation/OwnLabels.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// The memory of judgeFartherReturns(). Keep it from scan to scan, so that none is allocated; it
/// carries nothing over. Lists may be longer than their contents.
struct FartherReturnsWorkspace {
    std::vector<std::int32_t> index;   ///< in the scan, of the returns to judge
    std::vector<float> x_m, y_m, z_m;  ///< in the ground's frame
    std::vector<float> height_m;       ///< above the surface
};

/// A pixel may hold several returns, and its label is that of the closest. A return that lies more
/// than 0.3 m behind the closest gets a label of its own: RoI where its height above the ground
/// exceeds the pixel's tolerance or where it violates the clearance, otherwise ROU. Where there is
/// no surface of the ground, no return does. Requires `image` and `ground` to be those of this
/// scan.
void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         const Clearance& clearance, OwnLabels& own_labels,
                         FartherReturnsWorkspace& work);

}  // namespace hagen
