#include <hagen/simulation/Lidar.h>
#include <stdexcept>

namespace hagen::simulation {

FiringPattern firingPattern(const SensorModel& sensor) {
    FiringPattern pattern;
    const auto rows = static_cast<std::uint8_t>(sensor.rows());
    if (sensor.name == "VLP-16") {
        pattern = {{}, 2.304, 55.296, 1809, 16};
    } else if (sensor.name == "HDL-32E") {
        pattern = {{}, 1.152, 46.080, 2170, 32};
    } else if (sensor.name == "HDL-64E") {
        pattern = {{}, 0.720, 48.0, 2083, 64};
    } else if (sensor.name == "Mid-360") {
        return {{}, 1e5 / 19965, 4e5 / 19965, 4991, 4};  // 19 965 points per 0.1 s
    } else if (sensor.name == "Avia") {
        return {{}, 25.0 / 6, 25.0, 4000, 6};  // 240 000 points per second
    } else if (sensor.name == "HAP") {
        return {{}, 1 / 0.452, 4 / 0.452, 11300, 4};  // 452 000 points per second
    } else {
        throw std::invalid_argument("the sensor '" + sensor.name + "' cannot be simulated; " +
                                    "use VLP-16, HDL-32E, HDL-64E, Mid-360, Avia or HAP");
    }
    // Lasers of the lower and the upper half alternate.
    for (std::uint8_t row = 0; row < rows / 2; ++row) {
        pattern.row_of_laser.push_back(row);
        pattern.row_of_laser.push_back(static_cast<std::uint8_t>(row + rows / 2));
    }
    return pattern;
}

SensorErrorModel sensorErrors(const SensorModel& sensor) {
    SensorErrorModel errors;
    if (!sensor.has_rings) {
        // 10 % of the returns are lost at 0.69 of the half range. At 10 % reflectivity, the half
        // range is 0.58 times that of a grey wall (30 %).
        const double range_m = sensor.name == "Avia" ? 190 : sensor.name == "HAP" ? 150 : 40;
        errors.half_range_m = 2.5 * range_m;
        errors.min_noise_m = 0.018;  // 2 cm at 10 or 20 m, where noise is up to 10 % higher
    }
    return errors;
}

}  // namespace hagen::simulation
