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
    if (name == "VLS-128") {
        const double offsets_deg[] = {6.354, 4.548, 2.732, 0.911, -0.911, -2.732, -4.548, -6.354};
        for (const double elevation_deg :
             {-11.742, -1.99, 3.4,   -5.29,   -0.78, 4.61,   -4.08, 1.31,   -6.5,  -1.11,   4.28,
              -4.41,   0.1,   6.48,  -3.2,    2.19,  -3.86,  1.53,  -9.244, -1.77, 2.74,    -5.95,
              -0.56,   4.83,  -2.98, 2.41,    -6.28, -0.89,  3.62,  -5.07,  0.32,  7.58,    -0.34,
              5.18,    -3.64, 1.75,  -25.0,   -2.43, 2.96,   -5.73, 0.54,   9.7,   -2.76,   2.63,
              -7.65,   -1.55, 3.84,  -4.85,   3.18,  -5.51,  -0.12, 5.73,   -4.3,  1.09,    -16.042,
              -2.21,   4.06,  -4.63, 0.76,    15.0,  -3.42,  1.97,  -6.85,  -1.33, -5.62,   -0.23,
              5.43,    -3.53, 0.98,  -19.582, -2.32, 3.07,   -4.74, 0.65,   11.75, -2.65,   1.86,
              -7.15,   -1.44, 3.95,  -2.1,    3.29,  -5.4,   -0.01, 4.5,    -4.19, 1.2,     -13.565,
              -1.22,   4.17,  -4.52, 0.87,    6.08,  -3.31,  2.08,  -6.65,  1.42,  -10.346, -1.88,
              3.51,    -6.06, -0.67, 4.72,    -3.97, 2.3,    -6.39, -1.0,   4.39,  -5.18,   0.21,
              6.98,    -3.09, 4.98,  -3.75,   1.64,  -8.352, -2.54, 2.85,   -5.84, -0.45,   8.43,
              -2.87,   2.52,  -6.17, -1.66,   3.73,  -4.96,  0.43}) {
            beams.push_back({elevation_deg, offsets_deg[beams.size() % 8]});
        }
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
