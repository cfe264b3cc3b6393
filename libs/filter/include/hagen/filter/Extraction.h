#pragma once
#include <hagen/filter/OwnLabels.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/RangeImage.h>
#include <hagen/scan/Scan.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The labels of a scan's returns, and the returns of each label.
struct LabelledReturns {
    std::vector<Label> label;  ///< label of each return, in the scan's order
    /// RoI component; 1 is the nearest, 0 means none. Empty without Options::number_obstacles.
    std::vector<std::int32_t> component;
    /// Indices of the returns with each label, ascending; every return is in exactly one list.
    std::vector<std::uint32_t> roi, rou, unclassified;
};

/// Workspace of extractReturns(). Reuse it between scans to avoid allocations; it has no state.
/// Lists may have unused entries at the end.
struct ExtractionWorkspace {
    std::vector<Label> label_of_pixel;  ///< [0] is for no pixel
    std::vector<std::uint32_t> roi, rou, unclassified;
};

/// Stage 9, extraction: a return takes the label of its pixel (depth_mapper), unless it has its own
/// label or is beyond `zone_m` (ROU). In the zone, a return without a pixel is RoI: it is outside
/// the sensor's range limits, so its position is doubtful, but an object is there. Only returns
/// without range (0, not finite) are Unclassified. Requires `image`, `labels` and `own_labels` of
/// this scan. Leaves `returns.component` unchanged.
void extractReturns(const Scan& scan, const RangeImage& image, const Image<Label>& labels,
                    const OwnLabels& own_labels, float zone_m, LabelledReturns& returns,
                    ExtractionWorkspace& work);

}  // namespace hagen
