#include "Inputs.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/settings/Settings.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <cstdlib>
#include <set>

#include <hagen/convert/SimulatedObservation.h>

namespace hagen {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kStart_s = 5, kScanPeriod_s = 0.1;

/// Calls `add(scene, flight, time_s, random)` for each scan.
template <class Add>
void flyThroughScenes(int scans, const Add& add) {
    for (const char* scenario : {"orchard", "street", "field", "forest-0.05"}) {
        const simulation::Scene scene = simulation::makeScene(scenario, kSeed);
        const simulation::Flight flight(scene.terrain(), scene.path(), {}, kSeed);
        simulation::Random random(kSeed, 3);
        for (int i = 0; i < scans; ++i) add(scene, flight, kStart_s + kScanPeriod_s * i, random);
    }
}

}  // namespace

Input simulatedPackets(const std::string& sensor, int scans) {
    Input input{sensorModel(sensor)};
    flyThroughScenes(scans, [&](const auto& scene, const auto& flight, double time_s,
                                simulation::Random& random) {
        const auto scan = simulation::simulateScan(scene, input.model, flight, time_s, random);
        input.packets.push_back(convert::encodeSimulatedScan(scan, input.model, time_s));
    });
    input.model = observations::sensorOf(*input.packets.front());
    return input;
}

Input simulatedOs1(int columns, int scans) {
    constexpr int kBeams = 128;
    std::vector<double> elevations_deg(kBeams);
    for (int b = 0; b < kBeams; ++b) elevations_deg[b] = -21.2 + 42.4 * b / (kBeams - 1);
    Input input{customSensorModel(elevations_deg), columns};
    input.model.max_range_m = 200;
    const PixelDirections directions = pixelDirections(input.model, columns);
    std::vector<simulation::Ray> rays;
    std::vector<Eigen::Vector3f> along;
    std::vector<simulation::RayHit> hits;
    flyThroughScenes(scans, [&](const auto& scene, const auto& flight, double time_s,
                                simulation::Random& random) {
        rays.clear();
        along.clear();
        for (int column = 0; column < columns; ++column) {
            const simulation::SensorPose pose =
                flight.at(time_s + kScanPeriod_s * column / columns);
            for (int row = 0; row < kBeams; ++row) {
                along.emplace_back(directions.row_cosine[row] * directions.column_cosine[column],
                                   directions.row_cosine[row] * directions.column_sine[column],
                                   directions.row_sine[row]);
                rays.push_back({pose.position_m.template cast<float>(),
                                pose.attitude.template cast<float>() * along.back()});
            }
        }
        scene.snapshotOver(time_s, kScanPeriod_s).cast(rays, input.model.max_range_m, hits);
        Scan& scan = input.points.emplace_back();
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (!hasValue(hits[i].range_m)) continue;
            const auto noise_m = static_cast<float>(0.015 * random.normal());
            const Eigen::Vector3f point = along[i] * (hits[i].range_m + noise_m);
            scan.x_m.push_back(point.x());
            scan.y_m.push_back(point.y());
            scan.z_m.push_back(point.z());
            scan.intensity.push_back(0.5f);
        }
    });
    return input;
}

Input realScansOf64Beams(int scans) {
    namespace fs = std::filesystem;
    const char* const data = std::getenv("HAGEN_LABELLED_DATA");
    if (data == nullptr) throw std::runtime_error("HAGEN_LABELLED_DATA is not set");
    const fs::path drives = fs::path(data) / "beams64";
    Input input;
    for (const fs::path& drive : std::set<fs::path>(fs::directory_iterator(drives), {})) {
        const recordings::ScanFolder folder(drive);
        Settings settings;
        mergeSettings(folder.sensorFile(), settings);
        input.model = settings.sensorModel();
        for (std::size_t i = 0; i < std::min<std::size_t>(folder.size(), scans); ++i) {
            recordings::readScan(folder.scanFile(i), input.points.emplace_back());
        }
    }
    return input;
}

}  // namespace hagen
