#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Core>
#include <optional>

namespace hagen {

/// The sensor's orientation. The stages need images whose rows rise against gravity.
enum class Posture {
    Upright,     ///< tilted by up to 30 degrees: the sensor's rows rise
    UpsideDown,  ///< as far from upside down: the reversed rows rise
    OnItsSide    ///< in between: uses virtual rows in the level frame
};

/// The posture for a tilt; upright if the tilt is unknown. Virtual rows of the level frame are as
/// good as those of a sensor without rings, unless its rows are finer (depth cameras), so such a
/// sensor is upright only up to 15 degrees.
Posture postureOf(const std::optional<Attitude>& attitude, const SensorModel& sensor);

/// The sensor whose beams are the rows of the image. Upside down: the same beams with negated
/// elevations. On its side: virtual beams from -90 to 90 degrees, spaced by the median spacing of
/// the sensor's beams, but at least 1 degree.
SensorModel sensorIn(Posture posture, const SensorModel& sensor);

/// The rotation from the sensor frame to the image frame: the identity, 180 degrees about x, or the
/// rotation to the level frame.
Eigen::Matrix3f imageFromSensor(Posture posture, const std::optional<Attitude>& attitude);

/// The tilt of the image frame.
std::optional<Attitude> attitudeIn(Posture posture, const std::optional<Attitude>& attitude);

/// Rotates only the points of a scan.
void rotatePoints(const Eigen::Matrix3f& turn, const Scan& scan, Scan& turned);

/// Rotates a scan into the image frame and assigns the rows of `rows_of`, which is
/// sensorIn(posture, sensor). Not for upright sensors. Returns keep their order.
void turnScan(const Scan& scan, Posture posture, const std::optional<Attitude>& attitude,
              const SensorModel& rows_of, Scan& turned);

}  // namespace hagen
