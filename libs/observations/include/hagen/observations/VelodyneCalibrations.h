#pragma once
#include <hagen/packets/VelodyneCalibration.h>
#include <mrpt/obs/VelodyneCalibration.h>

namespace hagen::observations {

/// Converts the calibration of an observation, as it is, into `calibration`, whose memory is
/// reused.
void readCalibration(const mrpt::obs::VelodyneCalibration& of_observation,
                     packets::VelodyneCalibration& calibration);

/// The inverse, for observations.
mrpt::obs::VelodyneCalibration mrptCalibration(const packets::VelodyneCalibration& calibration);

}  // namespace hagen::observations
