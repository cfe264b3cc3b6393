// Uses the filter without MRPT: points in, obstacles out.
#include <hagen/filter/HagenFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
    // A scan contains x, y, z in the sensor frame: here, flat ground 1.5 m below and a narrow
    // pillar.
    const hagen::SensorModel sensor = hagen::sensorModel("VLP-16");
    hagen::Scan scan;
    for (int firing = 0; firing < 900; ++firing) {
        for (const float elevation_rad : sensor.elevations_rad) {
            const float azimuth_rad = static_cast<float>(firing) * 0.00698132f;  // 0.4 degrees
            const bool meets_pillar = std::abs(azimuth_rad - 0.5f) < 0.02f;
            const float ground_m = elevation_rad < 0 ? 1.5f / std::tan(-elevation_rad) : 1e9f;
            const float horizontal_m = meets_pillar ? std::min(8.0f, ground_m) : ground_m;
            if (horizontal_m > 100.0f) continue;
            scan.x_m.push_back(horizontal_m * std::cos(azimuth_rad));
            scan.y_m.push_back(horizontal_m * std::sin(azimuth_rad));
            scan.z_m.push_back(horizontal_m * std::tan(elevation_rad));
            scan.intensity.push_back(0.0f);
        }
    }
    // Compute ranges, azimuths and rows if the sensor does not provide them.
    hagen::locateBeams(sensor, scan);

    // Keep the filter: it reuses its memory for every scan.
    hagen::Options options;
    options.number_obstacles = true;
    hagen::HagenFilter filter(sensor, options);
    const hagen::SegmentationResult& result = filter.segment(scan);
    std::printf("%zu returns: %zu RoI, %zu ROU\n", scan.size(), result.returns.roi.size(),
                result.returns.rou.size());
    for (const auto i : result.returns.roi) {
        std::printf("  obstacle %d at x %.2f y %.2f z %.2f m\n", result.returns.component[i],
                    static_cast<double>(scan.x_m[i]), static_cast<double>(scan.y_m[i]),
                    static_cast<double>(scan.z_m[i]));
    }
}
