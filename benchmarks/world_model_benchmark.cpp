// Measures update time, query time and memory of each world model on a simulated flight.
#include <hagen/avoidance/WorldModel.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/settings/Settings.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace hagen;

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double heap_MB() {
    const auto info = mallinfo2();
    return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

std::vector<observations::MappedScan> flyThrough(const std::string& scenario, int scans) {
    const SensorModel sensor = sensorModel("VLP-16");
    const simulation::Scene scene = simulation::makeScene(scenario, 1);
    const simulation::Flight flight(scene.terrain(), scene.path(), {}, 1);
    Settings settings;
    mergeSettings(HAGEN_SOURCE_DIR "/config/vlp16.yaml", settings);
    HagenFilter filter(sensor, settings.options);
    simulation::Random random(1, 3);
    std::vector<observations::MappedScan> mapped;
    for (int i = 0; i < scans; ++i) {
        const double time_s = 0.1 * i;
        simulation::SimulatedScan made =
            simulation::simulateScan(scene, sensor, flight, time_s, random);
        const auto& labels = filter.segment(made.scan).returns.label;
        observations::MappedScan scan;
        scan.time_s = time_s + 0.1;
        scan.origin_m = flight.at(time_s + 0.05).position_m.cast<float>();
        for (std::size_t k = 0; k < made.size(); ++k) {
            if (labels[k] == Label::Unclassified) continue;
            const simulation::SensorPose pose = flight.at(time_s + made.scan.time_s[k]);
            const Eigen::Vector3d at(made.scan.x_m[k], made.scan.y_m[k], made.scan.z_m[k]);
            scan.points_m.push_back((pose.position_m + pose.attitude * at).cast<float>());
            scan.labels.push_back(labels[k]);
        }
        mapped.push_back(std::move(scan));
    }
    return mapped;
}

double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

void measure(const std::string& name, const std::vector<observations::MappedScan>& scans) {
    Eigen::AlignedBox3f bounds;
    for (const auto& scan : scans) bounds.extend(scan.origin_m);
    const Eigen::Vector3f around(10, 10, 2);
    bounds = {bounds.min() - around, bounds.max() + around};
    const double before_MB = heap_MB();
    const auto model = avoidance::makeWorldModel(
        name, {bounds, [](const Eigen::Vector3f&, double) { return 3.0f; }, {}});
    simulation::Random random(2);
    std::vector<double> update_ms, query_us;
    float sum = 0;
    for (const auto& scan : scans) {
        const double start = cpu_ms();
        model->update(scan);
        const double updated = cpu_ms();
        constexpr int kQueries = 2000;
        for (int i = 0; i < kQueries; ++i) {  // around and ahead of the vehicle, like a planner
            const double x = random.uniform(-6, 6);
            const double y = random.uniform(-6, 6);
            const double z = random.uniform(-1, 1);
            sum += model->clearance_m(scan.origin_m + Eigen::Vector3d(x, y, z).cast<float>());
        }
        update_ms.push_back(updated - start);
        query_us.push_back(1e3 * (cpu_ms() - updated) / kQueries);
    }
    const Eigen::Vector3f size = bounds.sizes();
    std::printf(
        "%-15s %7.2f %7.2f %7.2f %8.2f %8.2f %8.2f   %.0fx%.0fx%.0f m, mean clearance %.3f\n",
        name.c_str(), quantile(update_ms, 0.5), quantile(update_ms, 0.95), quantile(update_ms, 1),
        quantile(query_us, 0.5), 1e-6 * double(model->bytes()), heap_MB() - before_MB, size.x(),
        size.y(), size.z(), sum / 2000 / float(scans.size()));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string scenario = argc > 1 ? argv[1] : "forest-0.05";
    const int scans = argc > 2 ? std::stoi(argv[2]) : 100;
    const auto flight = flyThrough(scenario, scans);
    std::size_t points = 0, roi = 0;
    for (const auto& scan : flight) {
        points += scan.points_m.size();
        for (const Label label : scan.labels) roi += label == Label::Roi;
    }
    std::printf("%s, %d scans, %zu points per scan, %zu of them RoI\n", scenario.c_str(), scans,
                points / flight.size(), roi / flight.size());
    std::printf("%-15s %23s %8s %8s %8s\n", "", "update ms p50, p95, max", "query us", "MB",
                "heap");
    for (const std::string& name : avoidance::worldModelNames()) {
        bool wanted = argc <= 3;
        for (int i = 3; i < argc; ++i)
            wanted = wanted || name == avoidance::worldModelFrom(argv[i]);
        if (wanted) measure(name, flight);
    }
}
