#include <hagen/scan/Angle.h>
#include <hagen/scan/SensorModel.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hagen {
namespace {

/// `count` evenly spaced elevations from `lowest_deg` upwards.
std::vector<double> evenly(int count, double lowest_deg, double step_deg) {
    std::vector<double> elevations_deg(count);
    for (int beam = 0; beam < count; ++beam) elevations_deg[beam] = lowest_deg + beam * step_deg;
    return elevations_deg;
}

std::vector<double> vls128Elevations() {
    std::vector<double> elevations_deg{-25.0,  -19.582, -16.042, -13.565, -11.742, -10.346,
                                       -9.244, -8.352,  -7.65,   -7.15,   -6.85,   -6.65};
    const std::vector<double> dense = evenly(104, -6.5, 0.11);
    elevations_deg.insert(elevations_deg.end(), dense.begin(), dense.end());
    for (const double elevation_deg :
         {4.98, 5.18, 5.43, 5.73, 6.08, 6.48, 6.98, 7.58, 8.43, 9.7, 11.75, 15.0}) {
        elevations_deg.push_back(elevation_deg);
    }
    return elevations_deg;
}

std::vector<double> hdl64Elevations() {
    std::vector<double> elevations_deg = evenly(32, -24.33, 0.5);               // lower block
    const std::vector<double> upper = evenly(32, -8.0 - 1.0 / 3.0, 1.0 / 3.0);  // upper block
    elevations_deg.insert(elevations_deg.end(), upper.begin(), upper.end());
    return elevations_deg;
}

struct KnownSensor {
    std::string name;
    std::vector<double> elevations_deg;
    float min_range_m, max_range_m;
    bool has_rings = true;
};

const std::vector<KnownSensor>& knownSensors() {
    static const std::vector<KnownSensor> sensors{
        {"VLP-16", evenly(16, -15.0, 2.0), 0.5f, 120.0f},
        {"HDL-32E", evenly(32, -92.0 / 3.0, 4.0 / 3.0), 0.5f, 100.0f},
        {"HDL-64E", hdl64Elevations(), 0.9f, 130.0f},
        {"Puck Hi-Res", evenly(16, -10.0, 4.0 / 3.0), 0.5f, 120.0f},
        {"VLP-32C",
         {-25.0, -15.639, -11.31, -8.843, -7.254, -6.148, -5.333, -4.667, -4.0,   -3.667, -3.333,
          -3.0,  -2.667,  -2.333, -2.0,   -1.667, -1.333, -1.0,   -0.667, -0.333, 0.0,    0.333,
          0.667, 1.0,     1.333,  1.667,  2.333,  3.333,  4.667,  7.0,    10.333, 15.0},
         0.5f,
         200.0f},
        {"VLS-128", vls128Elevations(), 0.5f, 245.0f},
        {"XT32", evenly(32, -16.0, 1.0), 0.05f, 120.0f},
        {"XT16", evenly(16, -15.0, 2.0), 0.05f, 120.0f},
        {"OS0-128", evenly(128, -45.0, 90.0 / 127), 0.5f, 100.0f},
        {"OS1-64", evenly(64, -21.2, 42.4 / 63), 0.5f, 200.0f},
        {"Mid-360", evenly(24, -6.5, 2.5), 0.1f, 70.0f, false},  // centres of bands
        {"Avia", evenly(40, -37.635, 1.93), 1.0f, 450.0f, false},
        {"HAP", evenly(16, -11.71875, 1.5625), 0.5f, 150.0f, false}};
    return sensors;
}

}  // namespace

int SensorModel::nearestRow(float elevation_rad) const {
    const auto above =
        std::lower_bound(elevations_rad.begin(), elevations_rad.end(), elevation_rad);
    if (above == elevations_rad.begin()) return 0;
    if (above == elevations_rad.end()) return rows() - 1;
    const auto below = above - 1;
    const auto nearest = *above - elevation_rad < elevation_rad - *below ? above : below;
    return static_cast<int>(nearest - elevations_rad.begin());
}

SensorModel sensorModel(const std::string& name) {
    for (const KnownSensor& known : knownSensors()) {
        if (known.name != name) continue;
        SensorModel sensor = customSensorModel(known.elevations_deg);
        sensor.name = known.name;
        sensor.min_range_m = known.min_range_m;
        sensor.max_range_m = known.max_range_m;
        sensor.has_rings = known.has_rings;
        return sensor;
    }
    std::string message = "unknown sensor model '" + name + "'; known:";
    for (const std::string& known : knownSensorModels()) message += " " + known + ",";
    throw std::invalid_argument(message + " or 'custom' with its elevations");
}

std::vector<std::string> knownSensorModels() {
    std::vector<std::string> names;
    for (const KnownSensor& known : knownSensors()) names.push_back(known.name);
    return names;
}

SensorModel customSensorModel(const std::vector<double>& elevations_deg) {
    if (elevations_deg.size() < 2 || elevations_deg.size() > 256) {
        throw std::invalid_argument("a sensor has 2 to 256 beams, not " +
                                    std::to_string(elevations_deg.size()));
    }
    SensorModel sensor;
    sensor.name = "custom";
    for (const double elevation_deg : elevations_deg) {
        if (!(std::abs(elevation_deg) <= 90.0)) {
            throw std::invalid_argument("a beam's elevation must be within +-90 degrees, not " +
                                        std::to_string(elevation_deg));
        }
        const float elevation_rad = static_cast<float>(radians(elevation_deg));
        if (!sensor.elevations_rad.empty() && elevation_rad <= sensor.elevations_rad.back()) {
            throw std::invalid_argument(
                "elevations must ascend from the lowest beam to the highest; " +
                std::to_string(elevation_deg) + " degrees is not above the previous one");
        }
        sensor.elevations_rad.push_back(elevation_rad);
    }
    return sensor;
}

}  // namespace hagen
