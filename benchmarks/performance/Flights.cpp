#include "Flights.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

#include <chrono>

#include <hagen/convert/SimulatedObservation.h>
#include "StageRows.h"
#include "evaluation/labelled_folders/Methods.h"

namespace hagen {
namespace {

constexpr double kScanPeriod_s = 0.1;
constexpr int kDistinctScans = 100;

template <class Work>
double millisecondsOf(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    return took.count();
}

/// Generates the scans of a flight in order.
class FlyingLidar {
 public:
    FlyingLidar(const std::string& scenario, std::uint64_t seed)
        : scene_(simulation::makeScene(scenario, seed)),
          flight_(scene_.terrain(), scene_.path(), simulation::FlightSettings(), seed),
          random_(seed, 3) {}
    simulation::SimulatedScan next() {
        return simulation::simulateScan(scene_, sensor_, flight_, kScanPeriod_s * scans_++,
                                        random_);
    }
    const SensorModel& sensor() const { return sensor_; }

 private:
    SensorModel sensor_ = sensorModel("VLP-16");
    simulation::Scene scene_;
    simulation::Flight flight_;
    simulation::Random random_;
    int scans_ = 0;
};

std::vector<evaluation::Method> methods() {
    Settings ours, papers;
    papers.options = paperOptions();
    std::vector<evaluation::Method> all;
    for (const evaluation::Method& method : evaluation::methodsFor(
             {{{"hagen, paper", papers, "", ""}, {"hagen, default", ours, "", ""}}, ours}, "")) {
        const bool is_tuned = method.name.find("tuned") != std::string::npos;
        if (!is_tuned) all.push_back(method);
    }
    return all;
}

}  // namespace

FlightTimes timeFlight(const std::string& scenario, std::uint64_t seed, int scans) {
    FlyingLidar lidar(scenario, seed);
    const std::vector<evaluation::Method> all = methods();
    FlightTimes times{scenario, {}, {}};
    for (const evaluation::Method& method : all) times.methods.push_back({method.name, {}});
    for (int scan = 0; scan < scans; ++scan) {
        const evaluation::ScanInput input{lidar.next().scan, {}};
        times.returns.push_back(input.scan.size());
        for (std::size_t m = 0; m < all.size(); ++m) {
            if (scan == 0) all[m].segment(input);  // warm-up
            times.methods[m].runs_ms.push_back(millisecondsOf([&] { all[m].segment(input); }));
        }
    }
    return times;
}

std::vector<double> packetsToLabels_ms(const Options& options, int runs) {
    FlyingLidar lidar("orchard", 1);
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> packets;
    for (int scan = 0; scan < kDistinctScans; ++scan) {
        packets.push_back(
            convert::encodeSimulatedScan(lidar.next(), lidar.sensor(), kScanPeriod_s * scan));
    }
    HagenFilter filter(observations::sensorOf(*packets.front()), options);
    observations::ObservationWorkspace decoder;
    Scan scan;
    std::vector<double> runs_ms;
    for (int run = -kDistinctScans; run < runs; ++run) {  // the first round is a warm-up
        const auto& observation = *packets[(run + kDistinctScans) % kDistinctScans];
        const double run_ms = millisecondsOf([&] {
            observations::decodePackets(observation, scan, decoder);
            filter.segment(scan);
        });
        if (run >= 0) runs_ms.push_back(run_ms);
    }
    return runs_ms;
}

}  // namespace hagen
