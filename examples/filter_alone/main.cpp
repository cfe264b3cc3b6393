// Uses only the filter: points in, labels out.
#include <hagen/filter/HagenFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// A scan of your sensor; here, flat ground 2 m below a VLP-16 and a wall 8 m ahead.
hagen::Scan nextScan(const hagen::SensorModel& sensor) {
    hagen::Scan scan;
    for (float azimuth_rad = -3.14f; azimuth_rad < 3.14f; azimuth_rad += 0.0035f) {
        for (const float elevation_rad : sensor.elevations_rad) {
            float horizontal_m = elevation_rad < 0 ? -2 / std::tan(elevation_rad) : 1000;
            if (std::abs(azimuth_rad) < 0.3f) {
                horizontal_m = std::min(horizontal_m, 8 / std::cos(azimuth_rad));
            }
            if (horizontal_m > 100) continue;  // no return
            scan.x_m.push_back(horizontal_m * std::cos(azimuth_rad));
            scan.y_m.push_back(horizontal_m * std::sin(azimuth_rad));
            scan.z_m.push_back(horizontal_m * std::tan(elevation_rad));
            scan.intensity.push_back(0);
        }
    }
    return scan;
}

int main() {
    const hagen::SensorModel sensor = hagen::sensorModel("VLP-16");
    hagen::HagenFilter filter(sensor);  // reuse it: it keeps its memory

    hagen::Scan scan = nextScan(sensor);
    hagen::locateBeams(sensor, scan);
    const hagen::SegmentationResult& result = filter.segment(scan);

    float nearest_m = 1000;
    for (const auto i : result.returns.roi) nearest_m = std::min(nearest_m, scan.range_m[i]);
    std::printf("%zu of %zu returns are RoI, the nearest at %.2f m\n", result.returns.roi.size(),
                scan.size(), static_cast<double>(nearest_m));
}
