// Times simulated scans in every scene, in scenes of at least 150 000 triangles, and along courses,
// as well as course generation and exact distances.
#include <benchmark/benchmark.h>
#include <hagen/avoidance/Course.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Scenarios.h>
#include <algorithm>
#include <cmath>
#include "avoidance/flights/TrialSensor.h"

namespace {

/// The scene with a finely meshed ground at long range.
hagen::simulation::Scene withWideGround(const hagen::simulation::Scene& scene) {
    constexpr double kFineLength_m = 85, kFineWidth_m = 65, kReach_m = 140;
    hagen::simulation::SceneContent content = scene.content();
    hagen::simulation::Random random(1);
    const auto ground =
        std::find_if(content.objects.begin(), content.objects.end(),
                     [](const hagen::simulation::SceneObject& object) {
                         return object.kind == hagen::simulation::ObjectClass::Terrain;
                     });
    content.shapes.at(ground->shape) =
        content.terrain.mesh(kFineLength_m, kFineWidth_m, kReach_m, random);
    return hagen::simulation::Scene(std::move(content));
}

void simulate(benchmark::State& state, const hagen::simulation::Scene& scene,
              const std::string& sensor) {
    const hagen::SensorModel model = hagen::sensorModel(sensor);
    const hagen::simulation::Flight flight(scene.terrain(), scene.path(), {}, 1);
    hagen::simulation::Random random(1);
    double time_s = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            hagen::simulation::simulateScan(scene, model, flight, time_s, random));
        time_s += 0.1;
    }
}

void makeCourses(benchmark::State& state, const std::string& name) {
    std::uint64_t seed = 1;
    for (auto _ : state) benchmark::DoNotOptimize(hagen::avoidance::makeCourse(name, seed++));
}

/// Scans along the straight line from start to goal, ignoring obstacles.
void scanCourse(benchmark::State& state, const std::string& name) {
    const hagen::avoidance::Course course = hagen::avoidance::makeCourse(name, 1);
    const hagen::SensorModel model = hagen::sensorModel("VLP-16");
    hagen::simulation::Random random(1);
    const hagen::simulation::PoseAt pose_at = [&](double time_s) {
        const double share = std::fmod(time_s, 10.0) / 10;
        return hagen::simulation::SensorPose{
            course.start_m + share * (course.goal_m - course.start_m),
            Eigen::Quaterniond::Identity()};
    };
    double time_s = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(hagen::simulation::simulateScan(
            course.scene, model, pose_at, time_s, random,
            hagen::avoidance::trialErrorModel(hagen::avoidance::Air::Dusty)));
        time_s += 0.7;
    }
}

void measureDistances(benchmark::State& state, const std::string& name) {
    const hagen::avoidance::Course course = hagen::avoidance::makeCourse(name, 1);
    hagen::simulation::Random random(1);
    double time_s = 0;
    for (auto _ : state) {
        const double x_m = random.uniform(0, 40), y_m = random.uniform(-12, 12);
        const Eigen::Vector3d at(x_m, y_m, course.start_m.z() + random.uniform(-1, 2));
        benchmark::DoNotOptimize(course.distance.at(at.cast<float>(), time_s += 0.001));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto add = [](const std::string& name, const auto& makeScene) {
        const auto run = [=](benchmark::State& state) { simulate(state, makeScene(), "VLP-16"); };
        benchmark::RegisterBenchmark((name + ", VLP-16").c_str(), run)
            ->Unit(benchmark::kMillisecond);
    };
    for (const std::string& scenario : hagen::simulation::scenarioNames()) {
        add(scenario, [=] { return hagen::simulation::makeScene(scenario, 1); });
    }
    for (const std::string scenario : {"street", "gap", "orchard", "forest-0.10"}) {
        add(scenario + " with a wide ground",
            [=] { return withWideGround(hagen::simulation::makeScene(scenario, 1)); });
    }
    using Run = void (*)(benchmark::State&, const std::string&);
    const auto addCourse = [](const std::string& what, const std::string& course, Run run,
                              benchmark::TimeUnit unit) {
        benchmark::RegisterBenchmark((what + " course " + course).c_str(), run, course)->Unit(unit);
    };
    for (const std::string& course : hagen::avoidance::courseNames()) {
        addCourse("make", course, makeCourses, benchmark::kMillisecond);
        addCourse("scan on", course, scanCourse, benchmark::kMillisecond);
        addCourse("distance on", course, measureDistances, benchmark::kMicrosecond);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
