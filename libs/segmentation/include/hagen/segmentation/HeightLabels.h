#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/CellTops.h>
#include <hagen/segmentation/PixelPoints.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// How high above the ground a return may be and still be ground.
struct HeightTolerance {
    float near_m = 0.17f;       ///< at the sensor
    float per_m = 0.005f;       ///< increase per metre of distance
    float beside_tall = 0.12f;  ///< decrease per metre of height of what stands there (at most 1.1)
};

/// The memory of toleratedHeights(). Keep it from scan to scan, so that none is allocated; it
/// carries nothing over.
struct ToleranceWorkspace {
    /// For each cell of CellTops the highest top of the cell and its neighbours.
    std::vector<float> tallest_m;
};

/// The tolerance of each pixel, at least 0.04 m; NaN where it is empty. It is less where something
/// tall stands in the same cell of 0.75 m or an adjacent one: there, a return a little above the
/// ground is the foot of an obstacle rather than grass.
/// `pixels` in the ground's frame, `tops` of their heights above the surface.
void toleratedHeights(const PixelPoints& pixels, const CellTops& tops,
                      const HeightTolerance& tolerance, Image<float>& tolerance_m,
                      ToleranceWorkspace& work);

/// RoI where a pixel is higher than its tolerance, otherwise ROU; Unclassified where it is empty.
void labelByHeight(const Image<float>& height_m, const Image<float>& tolerance_m,
                   Image<Label>& labels);

}  // namespace hagen
