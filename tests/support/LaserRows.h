#pragma once
#include <hagen/sensors/VelodyneCalibration.h>

#include <cstdint>
#include <vector>

namespace hagen::test {

/// The image row of each laser (row 0: lowest beam).
inline std::vector<std::uint8_t> rowsOfLasers(const sensors::VelodyneCalibration& calibration) {
    std::vector<std::uint8_t> rows(calibration.lasers.size());
    for (std::size_t laser = 0; laser < rows.size(); ++laser) {
        rows[laser] = sensors::rowOfLaser(calibration, laser);
    }
    return rows;
}

}  // namespace hagen::test
