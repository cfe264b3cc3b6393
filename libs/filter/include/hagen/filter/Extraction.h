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
    std::vector<Label> label;             ///< label of each return, in the scan's order
    std::vector<std::int32_t> component;  ///< RoI component; 1 is the nearest, 0 means none
    /// Indices of the returns with each label, ascending; every return is in exactly one list.
    std::vector<std::uint32_t> roi, rou, unclassified;
};

/// A labelled image, and the pixel of each return.
struct LabelledImage {
    const RangeImage& range_image;
    const Image<Label>& labels;
    const Image<std::int32_t>& components;  ///< numbered obstacles (RoiComponents.h)
};

/// Rules for returns that do not depend on their pixel.
struct ExtractionRules {
    float zone_m;  ///< farther returns are ROU
    /// The maximum distance of a return with its own label behind its pixel to belong to the
    /// pixel's component.
    float component_gap_m;
};

/// Workspace of extractReturns(). Reuse it between scans to avoid allocations; it has no state.
/// Lists may have unused entries at the end.
struct ExtractionWorkspace {
    std::vector<std::int32_t> verdict;  ///< 2 * component + 1 if ROU; [0] is for no pixel
    std::vector<std::int32_t> number;   ///< the new number of each component
    std::vector<std::uint32_t> roi, rou, unclassified;
};

/// Stage 9, extraction: a return takes the label and component of its pixel (depth_mapper), unless
/// it has its own label. In the zone, a return without a pixel is RoI without a component: it is
/// outside the sensor's range limits, so its position is doubtful, but an object is there. Only
/// returns without range (0, not finite) are Unclassified. Components keep their order and are
/// numbered 1, 2, ... without gaps. Requires `image` and `own_labels` of this scan.
void extractReturns(const Scan& scan, const LabelledImage& image, const OwnLabels& own_labels,
                    const ExtractionRules& rules, LabelledReturns& returns,
                    ExtractionWorkspace& work);

}  // namespace hagen
