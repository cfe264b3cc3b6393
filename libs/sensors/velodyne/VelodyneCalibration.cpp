#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneCalibration.h>

#include <cmath>
#include <map>

namespace hagen::sensors {
namespace {

/// A laser's direction, as listed in the manuals.
struct Beam {
    double elevation_deg;
    double azimuth_offset_deg = 0;  ///< clockwise
};

/// Beams of a model in firing order.
std::vector<Beam> beamsOfManual(const std::string& name) {
    std::vector<Beam> beams;
    if (name == "VLP-16") {
        for (int i = 0; i < 8; ++i) {
            beams.push_back({-15.0 + 2 * i});
            beams.push_back({1.0 + 2 * i});
        }
    }
    if (name == "Puck Hi-Res") {
        for (int i = 0; i < 8; ++i) {
            beams.push_back({-10.0 + i * 4.0 / 3.0});
            beams.push_back({2.0 / 3.0 + i * 4.0 / 3.0});
        }
    }
    if (name == "HDL-32E") {
        // The last digits match MRPT's calibration file.
        beams = {{-30.67}, {-9.3299999}, {-29.33}, {-8}, {-28}, {-6.6700001},
                 {-26.67}, {-5.3299999}, {-25.33}, {-4}, {-24}, {-2.6700001},
                 {-22.67}, {-1.33},      {-21.33}, {0},  {-20}, {1.33},
                 {-18.67}, {2.6700001},  {-17.33}, {4},  {-16}, {5.3299999},
                 {-14.67}, {6.6700001},  {-13.33}, {8},  {-12}, {9.3299999},
                 {-10.67}, {10.67}};
    }
    if (name == "VLP-32C") {
        beams = {{-25, 1.4},    {-1, -4.2},     {-1.667, 1.4},  {-15.639, -1.4}, {-11.31, 1.4},
                 {0, -1.4},     {-0.667, 4.2},  {-8.843, -1.4}, {-7.254, 1.4},   {0.333, -4.2},
                 {-0.333, 1.4}, {-6.148, -1.4}, {-5.333, 4.2},  {1.333, -1.4},   {0.667, 4.2},
                 {-4, -1.4},    {-4.667, 1.4},  {1.667, -4.2},  {1, 1.4},        {-3.667, -4.2},
                 {-3.333, 4.2}, {3.333, -1.4},  {2.333, 1.4},   {-2.667, -1.4},  {-3, 1.4},
                 {7, -1.4},     {4.667, 1.4},   {-2.333, -4.2}, {-2, 4.2},       {15, -1.4},
                 {10.333, 1.4}, {-1.333, -1.4}};
    }
    return beams;
}

std::map<std::string, VelodyneCalibration> calibrationsOfManuals() {
    std::map<std::string, VelodyneCalibration> calibrations;
    for (const VelodyneModel& model : velodyneModels()) {
        VelodyneCalibration& calibration = calibrations[model.name];
        for (const Beam& beam : beamsOfManual(model.name)) {
            calibration.lasers.push_back(laserAt(beam.elevation_deg));
            // Avoid negative zero, which is stored differently.
            if (beam.azimuth_offset_deg != 0) {
                calibration.lasers.back().azimuth_deg = -beam.azimuth_offset_deg;
            }
        }
    }
    return calibrations;
}

}  // namespace

VelodyneLaser laserAt(double elevation_deg) {
    // Round like MRPT's calibration, so that recordings contain the same numbers.
    const double elevation_rad = elevation_deg * kPi / 180.0;
    VelodyneLaser laser;
    laser.elevation_deg = elevation_deg;
    laser.elevation_sine = std::sin(elevation_rad);
    laser.elevation_cosine = std::cos(elevation_rad);
    return laser;
}

const VelodyneCalibration& defaultCalibration(const VelodyneModel& model) {
    static const auto of_manuals = calibrationsOfManuals();
    static const VelodyneCalibration none;
    const auto found = of_manuals.find(model.name);
    return found == of_manuals.end() ? none : found->second;
}

std::uint8_t rowOfLaser(const VelodyneCalibration& calibration, std::size_t laser) {
    const auto& lasers = calibration.lasers;
    const double sine = lasers[laser].elevation_sine;
    int lower = 0;
    for (std::size_t other = 0; other < lasers.size(); ++other) {
        const double other_sine = lasers[other].elevation_sine;
        if (other_sine < sine || (other_sine == sine && other < laser)) ++lower;
    }
    return static_cast<std::uint8_t>(lower);
}

std::vector<std::uint8_t> rowsOfLasers(const VelodyneCalibration& calibration) {
    std::vector<std::uint8_t> rows(calibration.lasers.size());
    for (std::size_t laser = 0; laser < rows.size(); ++laser) {
        rows[laser] = rowOfLaser(calibration, laser);
    }
    return rows;
}

void beamsOf(const VelodyneCalibration& calibration, std::vector<float>& elevations_rad) {
    elevations_rad.resize(calibration.lasers.size());
    for (std::size_t laser = 0; laser < elevations_rad.size(); ++laser) {
        const auto& correction = calibration.lasers[laser];
        elevations_rad[rowOfLaser(calibration, laser)] =
            static_cast<float>(std::atan2(correction.elevation_sine, correction.elevation_cosine));
    }
}

SensorModel sensorOf(const VelodyneCalibration& calibration, const std::string& name) {
    SensorModel sensor;
    sensor.name = name;
    beamsOf(calibration, sensor.elevations_rad);
    return sensor;
}

}  // namespace hagen::sensors
