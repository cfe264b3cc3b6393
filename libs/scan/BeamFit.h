#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <optional>

namespace hagen {

/// How well a cloud agrees with the sensor that it is said to be from.
struct BeamFit {
    std::size_t returns = 0;  ///< with a range
    /// Share of the returns whose elevation is within kBeamFitTolerance_deg of a beam.
    float returns_share = 0.0f;
    /// Beams of the sensor, from the lowest to the highest that the cloud shows, and those of them
    /// that it shows. 0: the cloud shows no beams, because they are too close or were blurred.
    std::size_t beams = 0, beams_seen = 0;
    std::size_t beams_shown = 0;  ///< beams that the cloud shows, whether the sensor has them
    /// Share of the columns with a return, of the row that a quarter of the rows exceed: about 1
    /// where the sensor sees ground or walls, little if the sensor of the cloud has fewer beams.
    float filled = 0.0f;

    /// The share that fits, 0 to 1: the smaller one of the returns' and of the beams'. Beams that
    /// only one side has do not fit.
    float share() const;
};

/// Beams that calibration or motion within a turn displaced are still found with it; on beams two
/// degrees apart, returns of another sensor are within it by chance in 40 % of the cases.
constexpr double kBeamFitTolerance_deg = 0.4;

/// Compares the elevations of a scan with the beams of a sensor. The coordinates are those of the
/// sensor's frame; range, azimuth and row are not used. `columns`: of the image. None if fewer than
/// kMinReturnsForBeams returns have a range, or if the sensor has no rings.
std::optional<BeamFit> fitBeams(const Scan& scan, const SensorModel& sensor, int columns);

}  // namespace hagen
