#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen {

/// The bounding box of a RoI component.
struct RoiBox {
    std::int32_t component;         ///< its number, 1 the nearest
    std::uint32_t returns;          ///< number of returns
    float nearest_m;                ///< range of the closest
    Eigen::AlignedBox3f extents_m;  ///< in the sensor frame, axis-aligned
};

/// One box per component, ordered by number. Requires `returns` of this scan.
std::vector<RoiBox> boxRoiComponents(const Scan& scan, const LabelledReturns& returns);

/// Those worth drawing, in their order: of 30 returns or more, and not inside another such box.
/// Boxes around fewer, and boxes in boxes, would only hide points.
std::vector<RoiBox> boxesToDraw(const std::vector<RoiBox>& boxes);

}  // namespace hagen
