#include <hagen/simulation/Lidar.h>
#include <stdexcept>

namespace hagen::simulation {

FiringPattern firingPattern(const SensorModel& sensor) {
    FiringPattern pattern;
    const auto rows = static_cast<std::uint8_t>(sensor.rows());
    if (sensor.name == "VLP-16") {
        pattern = {{}, 2.304, 55.296, 1809};
    } else if (sensor.name == "HDL-32E") {
        pattern = {{}, 1.152, 46.080, 2170};
    } else if (sensor.name == "HDL-64E") {
        pattern = {{}, 0.720, 48.0, 2083};
    } else {
        throw std::invalid_argument("no sensor '" + sensor.name +
                                    "' can be simulated; VLP-16, HDL-32E and HDL-64E can");
    }
    // Lasers of the lower and of the upper half fire alternately.
    for (std::uint8_t row = 0; row < rows / 2; ++row) {
        pattern.row_of_laser.push_back(row);
        pattern.row_of_laser.push_back(static_cast<std::uint8_t>(row + rows / 2));
    }
    return pattern;
}

}  // namespace hagen::simulation
