#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <optional>

namespace hagen {

/// Agreement between a cloud and its presumed sensor.
struct BeamFit {
    std::size_t returns = 0;  ///< with a range
    /// Share of the returns whose elevation is within kBeamFitTolerance_deg of a beam.
    float returns_share = 0.0f;
    /// Beams of the sensor between the lowest and the highest that the cloud shows, and the number
    /// of those that it shows. 0: no beams are visible, because they are too close or blurred.
    std::size_t beams = 0, beams_seen = 0;
    std::size_t beams_shown = 0;  ///< all beams that the cloud shows
    /// Share of the columns with a return, in the row that a quarter of the rows exceed: about 1
    /// where the sensor sees ground or walls, low if the cloud's sensor has fewer beams.
    float filled = 0.0f;

    /// The share that fits, 0 to 1: the lower of the shares of returns and of beams. Beams that
    /// only the cloud or only the sensor has do not fit.
    float share() const;
};

/// Wide enough for beams displaced by calibration or by motion within a sweep. With beams two
/// degrees apart, 40 % of another sensor's returns are within the tolerance by chance.
constexpr double kBeamFitTolerance_deg = 0.4;

/// Compares the elevations of a scan with the beams of a sensor. Uses only the coordinates, in the
/// sensor's frame. `columns`: of the image. Returns nullopt if fewer than kMinReturnsForBeams
/// returns have a range, or if the sensor has no rings.
std::optional<BeamFit> fitBeams(const Scan& scan, const SensorModel& sensor, int columns);

}  // namespace hagen
