#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/PixelPoints.h>

namespace hagen {

/// Makes RoI of the ground that comes too close: ROU pixels that lie less than
/// `least_clearance_m` below the sensor. 0: none.
/// `pixels` and `sensor_m` (where the sensor is) are in one frame, `up` is its unit vector against
/// gravity, or the ground's normal where gravity is not known.
void alarmLowGround(const PixelPoints& pixels, const Eigen::Vector3f& sensor_m,
                    const Eigen::Vector3f& up, float least_clearance_m, Image<Label>& labels);

}  // namespace hagen
