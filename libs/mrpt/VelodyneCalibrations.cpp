#include <hagen/mrpt/VelodyneCalibrations.h>

#include <cmath>
#include <limits>

namespace hagen::observations {

void readCalibration(const mrpt::obs::VelodyneCalibration& of_observation,
                     sensors::VelodyneCalibration& calibration) {
    calibration.lasers.clear();
    for (const auto& from : of_observation.laser_corrections) {
        sensors::VelodyneLaser& laser = calibration.lasers.emplace_back();
        laser.azimuth_deg = from.azimuthCorrection;
        laser.elevation_deg = from.verticalCorrection;
        laser.elevation_sine = from.sinVertCorrection;
        laser.elevation_cosine = from.cosVertCorrection;
        laser.distance_m = from.distanceCorrection;
        laser.horizontal_offset_m = from.horizontalOffsetCorrection;
        laser.vertical_offset_m = from.verticalOffsetCorrection;
        // Products that are not used here; where they are no numbers, the calibration is corrupt.
        if (!std::isfinite(from.sinVertOffsetCorrection + from.cosVertOffsetCorrection)) {
            laser.vertical_offset_m = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

mrpt::obs::VelodyneCalibration mrptCalibration(const sensors::VelodyneCalibration& calibration) {
    mrpt::obs::VelodyneCalibration converted;
    for (const sensors::VelodyneLaser& from : calibration.lasers) {
        auto& laser = converted.laser_corrections.emplace_back();
        laser.azimuthCorrection = from.azimuth_deg;
        laser.verticalCorrection = from.elevation_deg;
        laser.sinVertCorrection = from.elevation_sine;
        laser.cosVertCorrection = from.elevation_cosine;
        laser.distanceCorrection = from.distance_m;
        laser.verticalOffsetCorrection = from.vertical_offset_m;
        laser.horizontalOffsetCorrection = from.horizontal_offset_m;
        laser.sinVertOffsetCorrection = from.vertical_offset_m * from.elevation_sine;
        // Of no offset, MRPT makes a zero with the sign of the sine: recordings have its bytes.
        laser.cosVertOffsetCorrection = from.vertical_offset_m == 0
                                            ? laser.sinVertOffsetCorrection
                                            : from.vertical_offset_m * from.elevation_cosine;
    }
    return converted;
}

}  // namespace hagen::observations
