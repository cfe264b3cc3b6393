#pragma once
#include <hagen/sensors/VelodyneCalibration.h>

#include <filesystem>

namespace hagen::sensors {

/// Reads an HDL-64E calibration from the XML file supplied with the sensor (`db.xml`, serialised by
/// Boost; angles in degrees, distances in centimetres). Ignores close-range and intensity
/// corrections.
///
/// Throws std::runtime_error naming the file if it cannot be read, has another format, does not
/// have 64 different lasers, or if a correction is missing, not a number or implausible (angles
/// beyond 90 or 180 degrees, distances beyond 10 m), or if two lasers have the same elevation.
VelodyneCalibration readVelodyneCalibration(const std::filesystem::path& file);

}  // namespace hagen::sensors
