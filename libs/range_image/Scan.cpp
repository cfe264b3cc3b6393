#include <hagen/range_image/Image.h>
#include <hagen/range_image/Scan.h>
#include <algorithm>
#include <cmath>

namespace hagen {

void Scan::clear() {
    for (auto* values : {&x_m, &y_m, &z_m, &intensity, &range_m, &azimuth_rad, &time_s}) {
        values->clear();
    }
    row.clear();
}

void Scan::reserve(std::size_t returns) {
    for (auto* values : {&x_m, &y_m, &z_m, &intensity, &range_m, &azimuth_rad, &time_s}) {
        values->reserve(returns);
    }
    row.reserve(returns);
}

void locateBeams(const SensorModel& sensor, Scan& scan) {
    scan.range_m.assign(scan.size(), kNoValue);
    scan.azimuth_rad.assign(scan.size(), 0.0f);
    scan.row.assign(scan.size(), 0);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        const float range = std::sqrt(x * x + y * y + z * z);
        if (!std::isfinite(range) || range == 0.0f) continue;
        const float elevation = std::asin(std::clamp(z / range, -1.0f, 1.0f));
        scan.range_m[i] = range;
        scan.azimuth_rad[i] = std::atan2(y, x);
        scan.row[i] = static_cast<std::uint8_t>(sensor.nearestRow(elevation));
    }
}

}  // namespace hagen
