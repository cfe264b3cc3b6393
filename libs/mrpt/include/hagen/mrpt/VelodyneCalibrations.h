#pragma once
#include <hagen/sensors/VelodyneCalibration.h>
#include <mrpt/obs/VelodyneCalibration.h>

namespace hagen::observations {

/// Converts the calibration of an observation, as it is, into `calibration`, whose memory is
/// reused.
void readCalibration(const mrpt::obs::VelodyneCalibration& of_observation,
                     sensors::VelodyneCalibration& calibration);

/// The inverse, for observations.
mrpt::obs::VelodyneCalibration mrptCalibration(const sensors::VelodyneCalibration& calibration);

}  // namespace hagen::observations
