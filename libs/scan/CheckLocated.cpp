#include <hagen/scan/Angle.h>
#include <hagen/scan/MostReturns.h>
#include <hagen/scan/Scan.h>
#include <algorithm>
#include <cmath>

#include "scan/CheckRows.h"

namespace hagen {
namespace {

constexpr float kSameBeam_rad = static_cast<float>(radians(1));

/// True if both may belong to the same sensor, allowing for calibration differences.
bool areAlike(const BeamSpan& a, const BeamSpan& b) {
    return a.rows == b.rows && std::abs(a.lowest_rad - b.lowest_rad) <= kSameBeam_rad &&
           std::abs(a.highest_rad - b.highest_rad) <= kSameBeam_rad;
}

std::string textOf(const BeamSpan& beams) {
    const auto wholeDegrees = [](float angle_rad) {
        return std::to_string(std::lround(degrees(static_cast<double>(angle_rad))));
    };
    return std::to_string(beams.rows) + " beams from " + wholeDegrees(beams.lowest_rad) + " to " +
           wholeDegrees(beams.highest_rad) + " degrees";
}

[[noreturn]] void refuse(const std::string& what) {
    throw std::invalid_argument(what + "; call locateBeams() with the sensor that took the scan");
}

[[noreturn]] void refuseRows(const std::string& rows, const SensorModel& sensor) {
    refuse("the scan has " + rows + ", but the sensor " + sensor.name + " has " +
           textOf(beamSpan(sensor)));
}

/// True if each return with a range has finite coordinates.
bool havePlaces(const Scan& scan) {
    const float* const x_m = scan.x_m.data();
    const float* const y_m = scan.y_m.data();
    const float* const z_m = scan.z_m.data();
    const float* const range_m = scan.range_m.data();
    std::uint32_t misplaced = 0;  // avoids branches, for speed
    for (std::size_t i = 0, size = scan.size(); i < size; ++i) {
        const float zero = 0 * x_m[i] + 0 * y_m[i] + 0 * z_m[i];  // NaN if any is not finite
        misplaced |= static_cast<std::uint32_t>(std::isnan(zero)) &
                     static_cast<std::uint32_t>(!std::isnan(range_m[i]));
    }
    return misplaced == 0;
}

}  // namespace

BeamSpan beamSpan(const SensorModel& sensor) {
    if (sensor.rows() == 0) return {};
    return {sensor.rows(), sensor.elevations_rad.front(), sensor.elevations_rad.back()};
}

void checkRows(const Scan& scan, const SensorModel& sensor) {
    if (scan.size() > kMaxReturns) {
        throw std::invalid_argument("the scan has " + std::to_string(scan.size()) +
                                    " returns; the maximum is " + std::to_string(kMaxReturns));
    }
    if (scan.y_m.size() != scan.size() || scan.z_m.size() != scan.size()) {
        throw std::invalid_argument("the scan's x, y and z coordinates differ in number");
    }
    for (const std::size_t size : {scan.range_m.size(), scan.azimuth_rad.size(), scan.row.size()}) {
        if (size == scan.size()) continue;
        refuse("the scan has " + std::to_string(scan.size()) + " returns, but " +
               std::to_string(size) + " ranges, azimuths or rows");
    }
    if (scan.beams.rows > 0 && !areAlike(scan.beams, beamSpan(sensor))) {
        refuseRows("rows of " + textOf(scan.beams), sensor);
    }
    std::uint8_t max = 0;
    for (const std::uint8_t row : scan.row) max = std::max(max, row);
    if (scan.size() > 0 && max >= sensor.rows()) {
        refuseRows("a return in row " + std::to_string(max), sensor);
    }
}

void checkLocated(const Scan& scan, const SensorModel& sensor) {
    checkRows(scan, sensor);
    if (!havePlaces(scan)) {
        refuse("a return has a range, but non-finite coordinates");
    }
}

}  // namespace hagen
