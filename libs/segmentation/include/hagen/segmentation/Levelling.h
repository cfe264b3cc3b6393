#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/SensorModel.h>
#include <Eigen/Core>

namespace hagen {

/// How a sensor was tilted against the horizon, as aeronautics counts it: the sensor's frame
/// (x forward, y left, z up) is turned about y by `pitch_rad`, nose down positive, then about the
/// turned x by `roll_rad`, left side up positive. Heading plays no part.
struct Attitude {
    float roll_rad = 0, pitch_rad = 0;
};

/// The rotation from the sensor's frame to the level one with the same heading (z up).
Eigen::Matrix3f levelFromSensor(const Attitude& attitude);

/// Stage 6 of a tilted sensor: as rangeAngles(), but about the horizon and not about the airframe,
///
///   alpha = atan2(|dz|, |(dx, dy)|)
///
/// of the level coordinates of the two returns. With a level sensor it is rangeAngles() to within
/// rounding.
void levelRangeAngles(const Image<float>& depth_m, const SensorModel& sensor,
                      const Attitude& attitude, Image<float>& range_angle_rad);

}  // namespace hagen
