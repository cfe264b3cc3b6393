// The filter as an MRPT observation processor: prints the nearest obstacle of each scan of a
// rawlog.
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/observations/RawlogReader.h>

#include <algorithm>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: 02_process_observations LOG.rawlog [SETTINGS.yaml]\n");
        return 2;
    }
    hagen::Settings settings;
    if (argc > 2) hagen::mergeSettings(argv[2], settings);
    hagen::ObservationSegmenter segmenter;
    segmenter.initialize(settings);

    hagen::RawlogReader reader(argv[1]);
    hagen::ObservationSegmenter::Output out;
    while (const auto entry = reader.next()) {
        const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry);
        if (!observation || !segmenter.process(*observation, out)) continue;
        float nearest_m = settings.options.zone_m;
        for (const auto i : out.result->returns.roi) {
            nearest_m = std::min(nearest_m, out.scan->range_m[i]);
        }
        std::printf("%s: %zu RoI points, the nearest at %.2f m\n", observation->sensorLabel.c_str(),
                    out.roi->pointcloud->size(), static_cast<double>(nearest_m));
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
