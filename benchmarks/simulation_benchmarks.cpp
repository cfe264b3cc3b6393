// How long a simulated scan takes, in the scenes that cost most and least.
#include <benchmark/benchmark.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>

namespace {

void simulate(benchmark::State& state, const std::string& scenario, const std::string& sensor) {
    const hagen::Scene scene = hagen::makeScene(scenario, 1);
    const hagen::SensorModel model = hagen::sensorModel(sensor);
    const hagen::Flight flight(scene.terrain(), scene.path(), {}, 1);
    hagen::Random random(1);
    double time_s = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(hagen::simulateScan(scene, model, flight, time_s, random));
        time_s += 0.1;
    }
    state.counters["triangles"] = static_cast<double>(scene.triangles());
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string& scenario : hagen::scenarioNames()) {
        benchmark::RegisterBenchmark((scenario + ", VLP-16").c_str(), simulate, scenario, "VLP-16")
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
