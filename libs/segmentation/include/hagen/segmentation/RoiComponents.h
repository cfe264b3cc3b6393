#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/ColumnBits.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// The memory of numberRoiComponents(). Keep it from scan to scan, so that none is allocated; it
/// carries nothing over. A run is a stretch of RoI pixels of a column, each linked with the one
/// above. Lists may be longer than their contents.
struct ComponentsWorkspace {
    ColumnBits roi, lowest;  ///< RoI pixels with a depth, and those that are their run's lowest
    ColumnLinks links;       ///< RoI to RoI; of those between the same two runs only the lowest
    std::size_t runs = 0;
    std::vector<std::int32_t> run;       ///< for each pixel of the image
    std::vector<std::uint32_t> nearest;  ///< for each run: its least depth as bits, which order so
    std::vector<std::int32_t> first;     ///< for each run: an earlier one linked with it, or itself
    std::vector<std::uint64_t> closest;  ///< for a component's first run: its nearest run
    std::vector<std::int32_t> number;    ///< for each run: its component
    std::vector<std::uint64_t> order, swap;
    std::vector<float> depth_seam;         ///< copies of the columns at both ends of the image
    std::vector<std::uint8_t> label_seam;  ///< the same of labels
};

/// Numbers the obstacles: adjacent RoI pixels (4-neighbourhood, azimuth wrapped) whose depths
/// differ by less than `max_gap_m` are one component. Components are numbered from 1 by their
/// closest pixel, so that 1 is the nearest obstacle (of two equally near, the one with the smaller
/// pixel index); 0 on pixels that are not RoI, or have no depth.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components, ComponentsWorkspace& work);

}  // namespace hagen
