// How long a simulated scan takes: in every scene, and in some of at least 150 000 triangles.
#include <benchmark/benchmark.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>
#include <algorithm>

namespace {

/// The scene with a ground that is finely meshed farther out.
hagen::Scene withWideGround(const hagen::Scene& scene) {
    constexpr double kFineLength_m = 85, kFineWidth_m = 65, kReach_m = 140;
    hagen::SceneContent content = scene.content();
    hagen::Random random(1);
    const auto ground = std::find_if(
        content.objects.begin(), content.objects.end(),
        [](const hagen::SceneObject& object) { return object.kind == hagen::Kind::Terrain; });
    content.shapes.at(ground->shape) =
        content.terrain.mesh(kFineLength_m, kFineWidth_m, kReach_m, random);
    return hagen::Scene(std::move(content));
}

void simulate(benchmark::State& state, const hagen::Scene& scene, const std::string& sensor) {
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
    const auto add = [](const std::string& name, const auto& makeScene) {
        const auto run = [=](benchmark::State& state) { simulate(state, makeScene(), "VLP-16"); };
        benchmark::RegisterBenchmark((name + ", VLP-16").c_str(), run)
            ->Unit(benchmark::kMillisecond);
    };
    for (const std::string& scenario : hagen::scenarioNames()) {
        add(scenario, [=] { return hagen::makeScene(scenario, 1); });
    }
    for (const std::string scenario : {"street", "gap", "orchard", "forest-0.10"}) {
        add(scenario + " with a wide ground",
            [=] { return withWideGround(hagen::makeScene(scenario, 1)); });
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
