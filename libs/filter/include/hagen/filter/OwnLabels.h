#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The labels of returns that are labelled individually, because they lie behind the closest return
/// of their pixel. Written by judgeFartherReturns() for each scan, read by extractReturns().
struct OwnLabels {
    /// One element per return of the scan; empty if no ground was found, in which case every return
    /// takes the label of its pixel:
    ///
    ///     Unclassified  the return takes the label of its pixel
    ///     Rou, Roi      the return's own label; overruled only outside the zone (ROU) or the
    ///                   image (RoI)
    std::vector<Label> label;
    std::vector<std::int32_t> returns;  ///< those with a label of their own, ascending
};

}  // namespace hagen
