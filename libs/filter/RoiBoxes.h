#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen {

/// The bounding box of a RoI component.
struct RoiBox {
    std::int32_t component;         ///< component number; 1 is the nearest
    std::uint32_t returns;          ///< number of returns
    float nearest_m;                ///< range of the closest return
    Eigen::AlignedBox3f extents_m;  ///< in the sensor frame, axis-aligned
};

/// One box per component, ordered by number. `returns` must be from this scan; without numbered
/// obstacles, there are no boxes.
std::vector<RoiBox> boxRoiComponents(const Scan& scan, const LabelledReturns& returns);

/// The boxes worth drawing, in order: at least 30 returns, and not inside another drawn box.
/// Smaller and nested boxes would only hide points.
std::vector<RoiBox> boxesToDraw(const std::vector<RoiBox>& boxes);

}  // namespace hagen
