#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <cstdint>

namespace hagen {

/// Numbers the obstacles: RoI pixels side by side (4-neighbourhood, azimuth wrapped) whose depths
/// differ by less than `max_gap_m` are one component. Components are numbered from 1 by their
/// closest pixel, so that 1 is the nearest obstacle (of two equally near, the one with the smaller
/// pixel index); 0 on pixels that are not RoI, or have no depth.
void numberRoiComponents(const Image<float>& depth_m, const Image<Label>& labels, float max_gap_m,
                         Image<std::int32_t>& components);

}  // namespace hagen
