// Builds an OctoMap of a log's obstacles, with free space from the rays of all returns: filter,
// pose and map update per scan. `rawlog-segment --octomap` does the same, with more error checks.
#include <hagen/logs/LogPoses.h>
#include <hagen/logs/MapOutput.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/mapping/MapFile.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::fprintf(stderr, "usage: 03_roi_to_octomap LOG.rawlog MAP.bt [POSES.tum]\n");
        return 2;
    }
    // A pose may come after the scan that needs it, so poses are read first.
    const hagen::observations::Trajectory vehicle =
        hagen::logs::posesOfRawlog(hagen::logs::surveyRawlog(argv[1]), argc > 3 ? argv[3] : "")
            .vehicle;

    hagen::observations::ObservationSegmenter segmenter;
    hagen::mapping::ScanMap map({hagen::mapping::MapContent::RoiAndRays, 0.2, 20});
    std::size_t scans = 0, hits = 0;
    hagen::logs::RawlogReader reader(argv[1]);
    while (const auto entry = reader.next()) {
        const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry);
        hagen::observations::ObservationSegmenter::Output out;
        if (!observation || !segmenter.process(*observation, out, vehicle)) continue;
        // Places each return with the pose at its own time; none without a pose.
        const auto placed = hagen::logs::placeInMap(out, *observation, vehicle);
        if (!placed) continue;
        map.insert(placed->mapped);
        ++scans;
        hits += out.result->returns.roi.size();
    }
    hagen::mapping::saveMap(map.tree(), argv[2]);
    std::printf("%zu scans with %zu RoI points: %zu nodes in %s\n", scans, hits, map.tree().size(),
                argv[2]);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
