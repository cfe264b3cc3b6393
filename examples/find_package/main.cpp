// An external project that segments one scan with an installed Hagen.
#include <hagen/mrpt/ObservationSegmenter.h>

#include <cstdio>

int main() {
    // Any observation of your log; here a cloud of one point straight ahead.
    hagen::Scan scan;
    scan.x_m = {5.0f};
    scan.y_m = {0.0f};
    scan.z_m = {0.1f};
    scan.intensity = {0.5f};
    const auto observation = hagen::observations::observationOf(scan, "lidar", mrpt::Clock::now());

    hagen::observations::ObservationSegmenter segmenter;
    hagen::observations::ObservationSegmenter::Output out;
    if (!segmenter.process(*observation, out)) return 1;
    std::printf("%s: %zu points\n", out.roi->sensorLabel.c_str(), out.roi->pointcloud->size());
    return out.roi->pointcloud->size() == 1 ? 0 : 1;
}
