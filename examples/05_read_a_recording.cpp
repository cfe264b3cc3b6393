// Reads any recording: rawlog, network capture, bag, point clouds or scan folder. Prints the
// nearest obstacle of each scan.
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>

#include <algorithm>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::fprintf(stderr, "usage: 05_read_a_recording RECORDING\n");
        return 2;
    }
    const auto source = hagen::recordings::openRecording(argv[1]);
    hagen::observations::ObservationSegmenter segmenter;
    segmenter.initialize(source->useSettings({}));  // the recording may name its sensors

    while (const auto scan = source->nextScan()) {
        hagen::observations::ObservationSegmenter::Output out;
        if (!segmenter.process(*scan->observation, out, scan->pose, scan->beams)) continue;
        if (out.result->returns.roi.empty()) {
            std::printf("%s: no RoI points\n", titleOf(*scan).c_str());
            continue;
        }
        float nearest_m = out.scan->range_m[out.result->returns.roi.front()];
        for (const auto i : out.result->returns.roi) {
            nearest_m = std::min(nearest_m, out.scan->range_m[i]);
        }
        std::printf("%s: %zu RoI points, the nearest at %.2f m\n", titleOf(*scan).c_str(),
                    out.roi->pointcloud->size(), static_cast<double>(nearest_m));
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
