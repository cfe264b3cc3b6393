#include "Inputs.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <cmath>
#include <stdexcept>

#include <hagen/convert/SimulatedObservation.h>

namespace hagen {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr std::uint64_t kSeed = 1;

Scan coordinatesOf(const Scan& scan) {
    Scan points;
    points.x_m = scan.x_m;
    points.y_m = scan.y_m;
    points.z_m = scan.z_m;
    points.intensity = scan.intensity;
    return points;
}

}  // namespace

Input realVlp16() {
    const char* const file = "/usr/share/mrpt/datasets/test_velodyne_VLP16.rawlog";
    const auto scan =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(recordings::RawlogReader(file).next());
    if (!scan) throw std::runtime_error(std::string(file) + ": contains no Velodyne scan");
    return {"VLP-16", observations::sensorOf(*scan), {scan}, {}};
}

Input simulatedScans(const std::string& sensor) {
    Input input{sensor + " simulated", sensorModel(sensor), {}, {}};
    for (const char* scenario : {"orchard", "street", "field", "forest-0.05"}) {
        const simulation::Scene scene = simulation::makeScene(scenario, kSeed);
        const simulation::Flight flight(scene.terrain(), scene.path(), simulation::FlightSettings(),
                                        kSeed);
        simulation::Random random(kSeed, 3);
        const double start_s = 5;
        const simulation::SimulatedScan scan =
            simulation::simulateScan(scene, input.model, flight, start_s, random);
        if (sensor == "HDL-64E") {
            input.points.push_back(coordinatesOf(scan.scan));
        } else {
            input.packets.push_back(convert::encodeSimulatedScan(scan, input.model, start_s));
        }
    }
    if (!input.packets.empty()) input.model = observations::sensorOf(*input.packets.front());
    return input;
}

Input gridScan(int beams, int columns) {
    std::vector<double> elevations_deg(beams);
    for (int b = 0; b < beams; ++b) elevations_deg[b] = -25.0 + 40.0 * b / (beams - 1);
    Input input{std::to_string(beams) + " x " + std::to_string(columns),
                customSensorModel(elevations_deg),
                {},
                {}};
    const simulation::Scene scene = simulation::makeScene("orchard", kSeed);
    const simulation::Flight flight(scene.terrain(), scene.path(), simulation::FlightSettings(),
                                    kSeed);
    const simulation::SensorPose pose = flight.at(5);
    const PixelDirections directions = pixelDirections(input.model, columns);
    std::vector<simulation::Ray> rays;
    std::vector<Eigen::Vector3f> along;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < beams; ++row) {
            along.emplace_back(directions.row_cosine[row] * directions.column_cosine[column],
                               directions.row_cosine[row] * directions.column_sine[column],
                               directions.row_sine[row]);
            rays.push_back({pose.position_m.cast<float>(),
                            (pose.attitude * along.back().cast<double>()).cast<float>()});
        }
    }
    std::vector<simulation::RayHit> hits;
    scene.snapshotOver(5, 0.1).cast(rays, input.model.max_range_m, hits);
    simulation::Random random(kSeed, 4);
    Scan scan;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hasValue(hits[i].range_m)) continue;
        const double noise_m = 0.015 * random.normal();
        const Eigen::Vector3f point =
            along[i] * static_cast<float>(static_cast<double>(hits[i].range_m) + noise_m);
        scan.x_m.push_back(point.x());
        scan.y_m.push_back(point.y());
        scan.z_m.push_back(point.z());
        scan.intensity.push_back(0.5f);
    }
    input.points.push_back(scan);
    return input;
}

}  // namespace hagen
