#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/RangeImage.h>
#include <hagen/range_image/Scan.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// What the filter says of each return of a scan, and the returns of each kind.
struct LabelledReturns {
    std::vector<Label> label;             ///< an entry a return, in the scan's order
    std::vector<std::int32_t> component;  ///< RoI component, 1 the nearest; 0 for none
    /// Indices of the returns with each label, ascending; together every return once.
    std::vector<std::uint32_t> roi, rou, unclassified;
};

/// Stage 9, extraction: a return takes the label and the component of its pixel, through the
/// depth_mapper. Farther than `zone_m`, or than the image reaches, it is ROU; out of the sensor's
/// range Unclassified. `own_label` overrules the pixel's where it is not Unclassified
/// (FartherReturns.h); it has an entry a return, or none at all. A return so labelled RoI is of its
/// pixel's component where it is less than `component_gap_m` behind, else of none: what is seen
/// past an obstacle is no part of it. Components keep their order and are numbered 1, 2, ...
/// without gaps.
void extractReturns(const Scan& scan, const SensorModel& sensor, const RangeImage& image,
                    const Image<Label>& labels, const Image<std::int32_t>& components,
                    const std::vector<Label>& own_label, float zone_m, float component_gap_m,
                    LabelledReturns& returns);

}  // namespace hagen
