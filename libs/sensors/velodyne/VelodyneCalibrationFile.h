#pragma once
#include <hagen/sensors/VelodyneCalibration.h>

#include <filesystem>

namespace hagen::sensors {

/// Reads an HDL-64E calibration from the XML file that comes with the sensor (`db.xml`, serialised
/// by Boost): angles in degrees, distances in centimetres. Ignores close-range and intensity
/// corrections.
///
/// Throws std::runtime_error naming the file if it cannot be read or is not such XML, if the number
/// of lasers is not 64, if a laser is missing or occurs twice, if a correction is missing, not a
/// number or implausible (angles beyond 90 or 180 degrees, distances beyond 10 m), or if two lasers
/// have the same elevation.
VelodyneCalibration readVelodyneCalibration(const std::filesystem::path& file);

}  // namespace hagen::sensors
