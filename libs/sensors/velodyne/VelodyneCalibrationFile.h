#pragma once
#include <hagen/sensors/VelodyneCalibration.h>

#include <filesystem>

namespace hagen::sensors {

/// Reads the calibration of an HDL-64E from the XML file that comes with the sensor (`db.xml`, as
/// boost serialises it): angles in degrees, distances in centimetres. Corrections for close
/// distances and of intensities are not read.
///
/// Throws std::runtime_error naming the file if it cannot be read, is no such XML, is not of a
/// sensor with 64 lasers, if a laser is missing or there twice, if one of its corrections is
/// missing, no number, or implausible (angles beyond a right or straight angle, distances beyond 10
/// m), and if two lasers have the same elevation.
VelodyneCalibration readVelodyneCalibration(const std::filesystem::path& file);

}  // namespace hagen::sensors
