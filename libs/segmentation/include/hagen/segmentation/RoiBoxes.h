#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/segmentation/Extraction.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen {

/// The space that a RoI component fills.
struct RoiBox {
    std::int32_t component;         ///< its number, 1 the nearest
    std::uint32_t returns;          ///< how many
    float nearest_m;                ///< range of the closest
    Eigen::AlignedBox3f extents_m;  ///< in the sensor's frame, along its axes
};

/// One box per component, in the order of their numbers. Requires `returns` to be those of this
/// scan.
std::vector<RoiBox> boxRoiComponents(const Scan& scan, const LabelledReturns& returns);

}  // namespace hagen
