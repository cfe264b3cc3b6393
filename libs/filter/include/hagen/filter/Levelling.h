#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/PixelDirections.h>
#include <Eigen/Core>
#include <optional>

namespace hagen {

/// The sensor's tilt against the horizon, in the aeronautical convention: the sensor frame (x
/// forward, y left, z up) is rotated about y by `pitch_rad` (nose down is positive), then about the
/// rotated x by `roll_rad` (left side up is positive). The heading does not matter.
struct Attitude {
    float roll_rad = 0, pitch_rad = 0;
};

/// The rotation from the sensor frame to the level frame with the same heading (z up).
Eigen::Matrix3f levelFromSensor(const Attitude& attitude);

/// Stage 6 relative to the horizon instead of the airframe: like the rangeAngles() of a level
/// sensor (RangeAngle.h), but
///
///   alpha = atan2(|dz|, |(dx, dy)|)
///
/// in the level frame. Without an attitude, the result is identical to RangeAngle.h.
void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 const std::optional<Attitude>& attitude, Image<float>& range_angle_rad);

}  // namespace hagen
