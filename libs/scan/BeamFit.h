#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <optional>

namespace hagen {

/// How well a cloud fits its presumed sensor.
struct BeamFit {
    std::size_t returns = 0;  ///< number of returns with a range
    /// Share of the returns whose elevation is within kBeamFitTolerance_deg of a beam.
    float returns_share = 0.0f;
    /// Number of sensor beams between the lowest and the highest beam of the cloud, and how
    /// many of them the cloud has. 0 if no beams can be distinguished in the cloud.
    std::size_t beams = 0, beams_seen = 0;
    std::size_t beams_shown = 0;  ///< beams visible in the cloud
    /// The third quartile, over the rows, of the share of columns with a return: about 1 if the
    /// sensor sees ground or walls, low if the cloud's sensor has fewer beams.
    float filled = 0.0f;

    /// The lower of the shares of returns and of beams that fit, 0 to 1. Beams that only the cloud
    /// or only the sensor has do not fit.
    float share() const;
};

/// Tolerates beams displaced by calibration or by motion within a sweep. If beams are two degrees
/// apart, 40 % of another sensor's returns are within the tolerance by chance.
constexpr double kBeamFitTolerance_deg = 0.4;

/// Compares the elevations of a scan with the beams of a sensor. Uses only the coordinates, in the
/// sensor frame. `columns`: width of the image. Returns nullopt if fewer than kMinReturnsForBeams
/// returns have a range, or if the sensor has no rings.
std::optional<BeamFit> fitBeams(const Scan& scan, const SensorModel& sensor, int columns);

}  // namespace hagen
