#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/scan/Image.h>
#include <cstddef>
#include <cstdint>
#include <vector>
#include "filter/ColumnBits.h"

namespace hagen {

/// Workspace of numberRoiComponents(). Reuse it between scans to avoid allocations; it has no
/// state. A run is a vertical sequence of linked RoI pixels in a column. Lists may have unused
/// entries at the end.
struct ComponentsWorkspace {
    ColumnBits roi, lowest;  ///< RoI pixels with a depth, and the lowest pixel of each run
    ColumnLinks links;       ///< between RoI pixels; between two runs, only the lowest
    std::size_t runs = 0;
    std::vector<std::int32_t> run;       ///< per pixel: its run
    std::vector<std::uint32_t> nearest;  ///< per run: minimum depth as an order-preserving integer
    std::vector<std::int32_t> first;     ///< per run: an earlier run linked to it, or itself
    std::vector<std::uint64_t> closest;  ///< per first run of a component: its nearest run
    std::vector<std::int32_t> number;    ///< per run: its component
    std::vector<std::int32_t> without_gaps;  ///< per component: its final number
    std::vector<std::uint64_t> order, swap;
    std::vector<float> depth_seam;         ///< depths of the columns at both ends of the image
    std::vector<std::uint8_t> label_seam;  ///< labels of these columns
};

/// Numbers the obstacles: adjacent RoI pixels (4-neighbourhood, azimuth wrapped) whose depths
/// differ by less than `max_gap_m` form one component. Components are numbered from 1 by their
/// closest pixel (ties: smaller pixel index), so 1 is the nearest obstacle. Pixels that are not RoI
/// or have no depth get 0.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components, ComponentsWorkspace& work);

/// Gives each RoI return the component of its pixel, or 0 without a pixel. A return with its own
/// label belongs to it only within `max_gap_m` of the pixel's depth. Components keep their order
/// and are numbered 1, 2, ... without gaps. Requires the labels of `returns`.
void numberReturns(const Scan& scan, const RangeImage& image, const Image<std::int32_t>& components,
                   const OwnLabels& own_labels, float max_gap_m, LabelledReturns& returns,
                   ComponentsWorkspace& work);

}  // namespace hagen
