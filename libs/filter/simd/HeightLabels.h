#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/CellTops.h>
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Pixels farther below the surface indicate that the surface is not the ground.
constexpr float kMinGround_m = -1.5f;

/// The maximum height of ground returns above the surface.
struct HeightTolerance {
    float near_m = 0.17f;       ///< tolerance at the sensor
    float per_m = 0.005f;       ///< increase per metre of distance
    float beside_tall = 0.12f;  ///< decrease per metre of adjacent object height (up to 1.1 m)
};

/// Workspace of toleratedHeights(). Reuse it between scans to avoid allocations; it has no state.
struct ToleranceWorkspace {
    /// For each cell of CellTops, the highest top among it and its four neighbours.
    std::vector<float> tallest_m;
};

/// The tolerance of each pixel, at least 0.04 m; NaN if it is empty. It is smaller if the same 0.75
/// m cell or one of its four neighbours contains a tall object: there, a return slightly above the
/// ground is more likely the foot of an obstacle than grass. Within three times the sensor's height
/// above the ground, this reduction decreases to zero: from above, feet are detected without it.
/// `pixels` must be in the ground frame; `tops` must be computed from their heights above the
/// surface. Results for pixels outside the cells of `area` are undefined.
void toleratedHeights(const PixelPoints& pixels, const PixelCells& cells, const CellTops& tops,
                      const HeightTolerance& tolerance, float sensor_height_m,
                      Image<float>& tolerance_m, ToleranceWorkspace& work,
                      const CellArea& area = {});

/// Labels a pixel RoI if it is higher than its tolerance or more than 1.5 m below the surface,
/// Unclassified if it is empty, and otherwise ROU.
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);

}  // namespace hagen
