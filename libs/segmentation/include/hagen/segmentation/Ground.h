#pragma once
#include <hagen/segmentation/CellTops.h>
#include <hagen/segmentation/GroundSurface.h>
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Geometry>

namespace hagen {

/// What is known of the ground under a scan, beyond the paper. Images are I_h x I_w, NaN where a
/// pixel is empty.
struct Ground {
    bool is_seen = false;  ///< else nothing was judged by it, and all but the first three are old
    Eigen::Isometry3f from_sensor;  ///< into the frame of the plane that the ground lies about
    PixelPoints pixels;             ///< where the pixels lie, in that frame
    GroundSurface surface;          ///< under the ROU
    Image<float> height_m;          ///< of each pixel above the surface
    CellTops tops;                  ///< how high what stands in each cell reaches
    Image<float> tolerance_m;       ///< a pixel so high is still ground
};

}  // namespace hagen
