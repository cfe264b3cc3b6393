#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstddef>
#include <cstdint>
#include <vector>
#include "filter/ColumnBits.h"

namespace hagen {

/// Workspace of numberRoiComponents(). Reuse it between scans to avoid allocations; it has no
/// state. A run is a vertical sequence of linked RoI pixels in a column. Lists may be longer than
/// their contents.
struct ComponentsWorkspace {
    ColumnBits roi, lowest;  ///< RoI pixels with a depth, and the lowest pixel of each run
    ColumnLinks links;       ///< RoI to RoI; only the lowest between two runs
    std::size_t runs = 0;
    std::vector<std::int32_t> run;       ///< per pixel of the image
    std::vector<std::uint32_t> nearest;  ///< per run: minimum depth as bits, in the same order
    std::vector<std::int32_t> first;     ///< per run: an earlier run linked to it, or itself
    std::vector<std::uint64_t> closest;  ///< per first run of a component: its nearest run
    std::vector<std::int32_t> number;    ///< per run: its component
    std::vector<std::uint64_t> order, swap;
    std::vector<float> depth_seam;         ///< depths of the columns at both ends of the image
    std::vector<std::uint8_t> label_seam;  ///< their labels
};

/// Numbers the obstacles: adjacent RoI pixels (4-neighbourhood, azimuth wrapped) whose depths
/// differ by less than `max_gap_m` are one component. Components are numbered from 1 by their
/// closest pixel, so 1 is the nearest obstacle (ties: smaller pixel index); 0 for pixels that are
/// not RoI or have no depth.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components, ComponentsWorkspace& work);

}  // namespace hagen
