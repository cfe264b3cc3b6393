#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/PixelDirections.h>
#include <Eigen/Core>
#include <optional>

namespace hagen {

/// How a sensor was tilted against the horizon, as aeronautics counts it: the sensor's frame
/// (x forward, y left, z up) is turned about y by `pitch_rad`, nose down positive, then about the
/// turned x by `roll_rad`, left side up positive. Heading plays no part.
struct Attitude {
    float roll_rad = 0, pitch_rad = 0;
};

/// The rotation from the sensor's frame to the level one with the same heading (z up).
Eigen::Matrix3f levelFromSensor(const Attitude& attitude);

/// Stage 6 about the horizon and not about the airframe, where the attitude is known: as the
/// rangeAngles() of a level sensor (RangeAngle.h), but
///
///   alpha = atan2(|dz|, |(dx, dy)|)
///
/// of the level coordinates of the two returns.
void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 const std::optional<Attitude>& attitude, Image<float>& range_angle_rad);

}  // namespace hagen
