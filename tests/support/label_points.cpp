// Labels scans with the filter only, to count instructions:
// label-points MODEL COLUMNS default|fast REPEAT FILE.bin...
// Files contain float32 x, y, z, intensity. A single filter segments each scan REPEAT times.
#include <hagen/filter/HagenFilter.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

hagen::Scan readScan(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    if (!file) throw std::runtime_error(name + ": cannot be read");
    hagen::Scan scan;
    std::array<float, 4> point{};
    while (file.read(reinterpret_cast<char*>(point.data()), sizeof point)) {
        scan.x_m.push_back(point[0]);
        scan.y_m.push_back(point[1]);
        scan.z_m.push_back(point[2]);
        scan.intensity.push_back(point[3]);
    }
    return scan;
}

void label(hagen::HagenFilter& filter, const hagen::SensorModel& sensor, const std::string& name,
           int repeat) {
    hagen::Scan scan = readScan(name);
    hagen::locateBeams(sensor, scan);
    for (int i = 1; i < repeat; ++i) filter.segment(scan);
    const hagen::SegmentationResult& result = filter.segment(scan);
    std::printf("%zu returns, %zu RoI\n", scan.size(), result.returns.roi.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        std::fprintf(stderr, "usage: label-points MODEL COLUMNS default|fast REPEAT FILE...\n");
        return 2;
    }
    const hagen::SensorModel sensor = hagen::sensorModel(argv[1]);
    hagen::Options options;
    options.columns = std::atoi(argv[2]);
    options.raw_angles = std::string(argv[3]) == "fast";
    hagen::HagenFilter filter(sensor, options);
    for (int i = 5; i < argc; ++i) label(filter, sensor, argv[i], std::atoi(argv[4]));
}
