#pragma once
#include <hagen/filter/Ground.h>
#include <hagen/filter/OwnLabels.h>
#include <hagen/scan/RangeImage.h>
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <cstdint>
#include <vector>
#include "filter/ground/Clearance.h"

namespace hagen {

/// Workspace of judgeFartherReturns(). Reuse it between scans to avoid allocations; it has no
/// state. Lists may have unused entries at the end.
struct FartherReturnsWorkspace {
    std::vector<std::int32_t> index;   ///< indices of the returns to label
    std::vector<std::int32_t> block;   ///< their blocks (PixelCells.h)
    std::vector<float> x_m, y_m, z_m;  ///< in the ground frame
    std::vector<float> height_m;       ///< heights above the surface
};

/// Labels returns behind the closest return of their pixel, which determines the pixel's label. A
/// return more than 0.3 m behind it gets its own label: RoI if its height above the ground exceeds
/// the pixel's tolerance, if it is more than 1.5 m below the surface, if no evidence shows that the
/// surface there is ground (GroundEvidence.h), or if it violates the clearance; otherwise ROU.
/// Returns beyond `zone_m` are always ROU and get no label of their own. Without a ground surface,
/// no return gets its own label. Requires `image` and `ground` of this scan.
void judgeFartherReturns(const Scan& scan, const RangeImage& image, const Ground& ground,
                         const Clearance& clearance, float zone_m, OwnLabels& own_labels,
                         FartherReturnsWorkspace& work);

}  // namespace hagen
