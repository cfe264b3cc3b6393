// Segments a scan with known labels: flat ground 1.5 m below a VLP-16, and a pillar 8 m away.
#include <hagen/filter/HagenFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

int main() {
    const hagen::SensorModel sensor = hagen::sensorModel("VLP-16");
    hagen::Scan scan;
    std::vector<hagen::Label> truth;
    for (int firing = 0; firing < 900; ++firing) {
        for (const float elevation_rad : sensor.elevations_rad) {
            const float azimuth_rad = static_cast<float>(firing) * 0.00698132f;  // 0.4 degrees
            const float ground_m = elevation_rad < 0 ? 1.5f / std::tan(-elevation_rad) : 1e9f;
            const bool meets_pillar = std::abs(azimuth_rad - 0.5f) < 0.02f && ground_m > 8.0f;
            const float horizontal_m = meets_pillar ? 8.0f : ground_m;
            if (horizontal_m > 100.0f) continue;
            scan.x_m.push_back(horizontal_m * std::cos(azimuth_rad));
            scan.y_m.push_back(horizontal_m * std::sin(azimuth_rad));
            scan.z_m.push_back(horizontal_m * std::tan(elevation_rad));
            scan.intensity.push_back(0.0f);
            truth.push_back(meets_pillar ? hagen::Label::Roi : hagen::Label::Rou);
        }
    }
    hagen::locateBeams(sensor, scan);
    hagen::HagenFilter filter(sensor);
    const std::vector<hagen::Label> labels = filter.segment(scan).returns.label;
    std::size_t wrong = labels.size() == truth.size() ? 0 : 1, roi = 0;
    for (std::size_t i = 0; wrong == 0 && i < truth.size(); ++i) {
        roi += truth[i] == hagen::Label::Roi ? 1 : 0;
        if (labels[i] != truth[i]) {
            std::fprintf(stderr, "return %zu at z %.2f m: label %d\n", i,
                         static_cast<double>(scan.z_m[i]), static_cast<int>(labels[i]));
            ++wrong;
        }
    }
    std::printf("%zu of %zu returns are RoI\n", roi, labels.size());
    return wrong == 0 && roi > 50 ? 0 : 1;
}
