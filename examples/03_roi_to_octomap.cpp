// Builds an OctoMap of a log's obstacles, with free space from the rays of all returns: filter,
// pose and map update per scan. `rawlog-segment --octomap` does the same, with more error checks.
#include <hagen/convert/MapOutput.h>
#include <hagen/mrpt/MapFile.h>
#include <hagen/recordings/ScanSource.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::fprintf(stderr, "usage: 03_roi_to_octomap LOG.rawlog MAP.bt [POSES.tum]\n");
        return 2;
    }
    const auto log = hagen::recordings::openRecording(argv[1]);
    log->usePoses(argc > 3 ? argv[3] : "");  // reads the whole log: a pose may follow its scan
    const hagen::observations::Trajectory& vehicle = log->poses().vehicle;

    hagen::observations::ObservationSegmenter segmenter;
    segmenter.initialize(log->useSettings({}));
    hagen::observations::ScanMap map({hagen::observations::MapContent::RoiAndRays, 0.2, 20});
    std::size_t scans = 0, hits = 0;
    while (const auto scan = log->nextScan()) {
        hagen::observations::ObservationSegmenter::Output out;
        if (!segmenter.process(*scan->observation, out, scan->pose, scan->beams)) continue;
        // Places each return with the pose at its own time; nullopt without a pose.
        const auto placed = hagen::convert::placeInMap(out, *scan->observation, vehicle);
        if (!placed) continue;
        map.insert(placed->mapped);
        ++scans;
        hits += out.result->returns.roi.size();
    }
    if (scans == 0) {
        std::fprintf(stderr, "%s: no scan has a pose\n", argv[1]);
        return 1;
    }
    hagen::observations::saveMap(map.tree(), argv[2]);
    std::printf("%zu scans with %zu RoI points: %zu nodes in %s\n", scans, hits, map.tree().size(),
                argv[2]);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
