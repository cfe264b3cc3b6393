#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/CellTops.h>
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Pixels farther below the surface show that it is not the ground.
constexpr float kMinGround_m = -1.5f;

/// The maximum height above ground at which a return is still ground.
struct HeightTolerance {
    float near_m = 0.17f;       ///< at the sensor
    float per_m = 0.005f;       ///< increase per metre of distance
    float beside_tall = 0.12f;  ///< decrease per metre of height of objects beside (at most 1.1 m)
};

/// Workspace of toleratedHeights(). Reuse it between scans to avoid allocations; it has no state.
struct ToleranceWorkspace {
    /// For each cell of CellTops, the highest top among the cell and those at its sides.
    std::vector<float> tallest_m;
};

/// The tolerance of each pixel, at least 0.04 m; NaN if it is empty. It is smaller if something
/// tall stands in the same 0.75 m cell or in one of the four at its sides: there, a return slightly
/// above the ground is more likely the foot of an obstacle than grass. Nearer than three times the
/// sensor's height above the ground, this decreases to nothing: seen from above, feet are high
/// enough to be found without it. `pixels` in the ground frame, `tops` of their heights above the
/// surface. Those of pixels in other cells than those of `area` mean nothing.
void toleratedHeights(const PixelPoints& pixels, const PixelCells& cells, const CellTops& tops,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m, ToleranceWorkspace& work,
                      const CellArea& area = {});

/// RoI if a pixel is higher than its tolerance or more than 1.5 m below the surface; otherwise ROU.
/// Unclassified if it is empty.
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);

}  // namespace hagen
