#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/VelodyneModel.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::sensors {

/// Limit of a laser's range correction and offsets. Larger values mean a corrupt calibration.
inline constexpr double kMaxCorrection_m = 10;

/// The direction and corrections of a Velodyne laser.
struct VelodyneLaser {
    double azimuth_deg = 0;  ///< subtracted from the packet's azimuth
    double elevation_deg = 0;
    /// Sine and cosine are stored because the unit of the angle differs between calibrations.
    double elevation_sine = 0, elevation_cosine = 1;
    double distance_m = 0;
    /// Offset of the laser's exit point, perpendicular to the beam.
    double vertical_offset_m = 0, horizontal_offset_m = 0;
};

/// A Velodyne's lasers in packet order.
struct VelodyneCalibration {
    std::vector<VelodyneLaser> lasers;
};

/// Returns a laser at this elevation without other corrections.
VelodyneLaser laserAt(double elevation_deg);

/// Returns the default calibration of a model, from its manual. Empty for the HDL-64E, because
/// every HDL-64E has its own.
const VelodyneCalibration& defaultCalibration(const VelodyneModel& model);

/// Returns the image row of a laser (row 0: lowest beam), from the elevations of all.
std::uint8_t rowOfLaser(const VelodyneCalibration& calibration, std::size_t laser);

/// Returns the elevations of the calibration's beams, lowest first.
void beamsOf(const VelodyneCalibration& calibration, std::vector<float>& elevations_rad);

/// Returns the calibration's beams as a sensor, lowest first, with the default range limits of
/// SensorModel.
SensorModel sensorOf(const VelodyneCalibration& calibration, const std::string& name);

}  // namespace hagen::sensors
