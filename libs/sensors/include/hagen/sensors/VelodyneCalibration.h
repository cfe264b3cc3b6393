#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/VelodyneModel.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::sensors {

/// Of a laser's range, and of where its light leaves the sensor. With more, a calibration is
/// corrupt.
inline constexpr double kMaxCorrection_m = 10;

/// Where a laser of a Velodyne points, and what is added to its ranges.
struct VelodyneLaser {
    double azimuth_deg = 0;  ///< is subtracted from the packet's azimuth
    double elevation_deg = 0;
    /// The decoder uses these: they are right in every calibration, the angle's unit differs.
    double elevation_sine = 0, elevation_cosine = 1;
    double distance_m = 0;
    /// Of where the light leaves the sensor, perpendicular to the beam.
    double vertical_offset_m = 0, horizontal_offset_m = 0;
};

/// The lasers of a Velodyne in the order in which a packet has them.
struct VelodyneCalibration {
    std::vector<VelodyneLaser> lasers;
};

/// Returns a laser that looks up by an angle, without any other correction.
VelodyneLaser laserAt(double elevation_deg);

/// Returns the calibration that holds for each sensor of a model, by its manual. Empty for an
/// HDL-64E, of which each sensor has its own.
const VelodyneCalibration& defaultCalibration(const VelodyneModel& model);

/// Returns the image row of a laser, and of each laser (row 0: lowest beam), by the calibration's
/// elevations.
std::uint8_t rowOfLaser(const VelodyneCalibration& calibration, std::size_t laser);
std::vector<std::uint8_t> rowsOfLasers(const VelodyneCalibration& calibration);

/// Returns the elevations of the calibration's beams, lowest first.
void beamsOf(const VelodyneCalibration& calibration, std::vector<float>& elevations_rad);

/// Returns the calibration's beams as a sensor, lowest first. Range limits are those of
/// SensorModel.
SensorModel sensorOf(const VelodyneCalibration& calibration, const std::string& name);

}  // namespace hagen::sensors
