#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Labels of individual returns that lie behind the closest return of their pixel.
/// judgeFartherReturns() writes them for each scan, extractReturns() reads them.
struct OwnLabels {
    /// One element per return of the scan; empty if no ground was found, in which case every return
    /// takes the label of its pixel:
    ///
    ///     Unclassified  the return takes the label of its pixel
    ///     Rou, Roi      the return's own label; overruled only outside the zone (ROU) or the
    ///                   image (RoI)
    std::vector<Label> label;
    std::vector<std::int32_t> returns;  ///< indices of returns with their own label, ascending
};

}  // namespace hagen
