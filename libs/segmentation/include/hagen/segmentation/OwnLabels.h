#pragma once
#include <hagen/range_image/Label.h>
#include <vector>

namespace hagen {

/// The labels of returns that are judged by themselves, because they lie behind the closest return
/// of their pixel. judgeFartherReturns() makes them anew for each scan, extractReturns() obeys
/// them; nothing changes them in between.
struct OwnLabels {
    /// One entry per return of the scan, or none at all where no ground was found to judge by (then
    /// every return goes by its pixel):
    ///   Unclassified  the return goes by its pixel;
    ///   Rou, Roi      the return's own label, whatever its pixel's. Only being beyond the zone
    ///   (ROU)
    ///                 or out of the sensor's range (Unclassified) still overrules it.
    std::vector<Label> label;
};

}  // namespace hagen
