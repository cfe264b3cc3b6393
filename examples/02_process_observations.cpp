// Uses the filter as an MRPT observation processor, and prints the nearest obstacle of each scan of
// a rawlog that consists of observations or sensory frames.
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstdio>
#include <exception>

namespace {

void printNearest(const mrpt::obs::CObservation& observation,
                  hagen::observations::ObservationSegmenter& segmenter) {
    hagen::observations::ObservationSegmenter::Output out;
    if (!segmenter.process(observation, out)) return;  // not a LiDAR scan
    std::printf("%s: %zu RoI points", observation.sensorLabel.c_str(), out.roi->pointcloud->size());
    float nearest_m = -1.0f;
    for (const auto i : out.result->returns.roi) {
        const float range_m = out.scan->range_m[i];
        if (nearest_m < 0.0f || range_m < nearest_m) nearest_m = range_m;
    }
    if (nearest_m >= 0.0f) std::printf(", the nearest at %.2f m", static_cast<double>(nearest_m));
    std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: 02_process_observations LOG.rawlog [SETTINGS.yaml]\n");
        return 2;
    }
    hagen::Settings settings;
    if (argc > 2) hagen::mergeSettings(argv[2], settings);
    hagen::observations::ObservationSegmenter segmenter;
    segmenter.initialize(settings);

    hagen::recordings::RawlogReader reader(argv[1]);
    while (const auto entry = reader.next()) {
        if (const auto alone = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry)) {
            printNearest(*alone, segmenter);
        } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
            for (const auto& observation : *frame) printNearest(*observation, segmenter);
        }
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
