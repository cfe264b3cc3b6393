#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Core>
#include <optional>

namespace hagen {

/// How the sensor is held. The stages need images whose rows rise against gravity.
enum class Posture {
    Upright,     ///< tilted by up to 30 degrees: its own rows rise
    UpsideDown,  ///< less than 30 degrees from upside down: its rows rise in reverse order
    OnItsSide    ///< in between: virtual rows, in the level frame
};

/// The posture by the sensor's tilt; upright if it is unknown.
Posture postureOf(const std::optional<Attitude>& attitude);

/// The sensor whose beams are the rows of the image. Upside down: the same beams with negated
/// elevations. On its side: virtual beams from -90 to 90 degrees, evenly spaced by the median
/// spacing of the sensor's beams, at least 1 degree.
SensorModel sensorIn(Posture posture, const SensorModel& sensor);

/// The rotation from the sensor frame to the frame of the image: none, half a turn about x, or to
/// the level frame.
Eigen::Matrix3f imageFromSensor(Posture posture, const std::optional<Attitude>& attitude);

/// The tilt that is left in the frame of the image.
std::optional<Attitude> attitudeIn(Posture posture, const std::optional<Attitude>& attitude);

/// Rotates the scan of a sensor into the frame of the image, with rows of `rows_of`, which is
/// sensorIn(posture, sensor). Not for upright sensors. `turned` has the returns in the same order.
void turnScan(const Scan& scan, Posture posture, const std::optional<Attitude>& attitude,
              const SensorModel& rows_of, Scan& turned);

}  // namespace hagen
