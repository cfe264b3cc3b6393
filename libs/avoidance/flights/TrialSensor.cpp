#include "avoidance/flights/TrialSensor.h"
#include <hagen/settings/Settings.h>

#include "avoidance/flights/Streams.h"
#include "avoidance/flights/TurnTransforms.h"

namespace hagen::avoidance {
namespace {

constexpr std::uint64_t kFiringsPerStream = 4096;  // exceeds the firings of a turn

HagenFilter standardFilter(float zone_m) {
    Settings settings;  // the defaults, which match config/vlp16.yaml
    settings.options.zone_m = zone_m;
    settings.options.number_obstacles = true;  // for tracking
    return filterFor(settings.sensorModel(), settings.options);
}

}  // namespace

simulation::SensorErrorModel trialErrorModel(Air air) {
    simulation::SensorErrorModel faults;
    faults.min_noise_m = 0.02;
    faults.lost = 0.01;
    if (air == Air::Dusty) return faults;
    faults.mixed = 0;
    faults.dust_per_m = 0;
    faults.airframe = false;
    return faults;
}

Airframe trialAirframe(Air air) {
    Airframe airframe;
    if (air == Air::Clear) return airframe;
    airframe.boxes = {{{0.10f, 0.11f, -0.44f}, {0.38f, 0.38f, 0.00f}},
                      {{-0.39f, 0.11f, -0.46f}, {-0.11f, 0.39f, 0.00f}},
                      {{0.10f, -0.37f, -0.43f}, {0.37f, -0.10f, 0.00f}},
                      {{-0.41f, -0.39f, -0.47f}, {-0.12f, -0.11f, 0.00f}},
                      {{-0.08f, 0.28f, 0.03f}, {0.08f, 0.74f, 0.64f}}};
    airframe.spheres = {{{-0.23f, 0.02f, 0.14f}, 0.22f}};
    return airframe;
}

TrialSensor::TrialSensor(const Course& course, Air air, float zone_m)
    : course_(course),
      faults_(trialErrorModel(air)),
      airframe_(trialAirframe(air)),
      filter_(standardFilter(zone_m)) {}

simulation::SimulatedScan TrialSensor::measure(int number, const FlightTrace& trace) const {
    simulation::Random random(course_.seed, streams::kScan + static_cast<std::uint64_t>(number));
    const auto pose_at = [&](double time_s) { return trace.at(time_s); };
    simulation::SimulatedScan measured = simulation::simulateScan(
        course_.scene, filter_.sensor(), pose_at, kTurn_s * number, random, faults_);
    maskAirframe(airframe_, measured.scan);
    return measured;
}

simulation::SimulatedScan TrialSensor::measureFirings(int number,
                                                      const simulation::FiringRange& firings,
                                                      const FlightTrace& trace) const {
    const auto firing = static_cast<std::uint64_t>(number) * kFiringsPerStream +
                        static_cast<std::uint64_t>(firings.first);
    simulation::Random random(course_.seed, streams::kFirings + firing);
    const auto pose_at = [&](double time_s) { return trace.at(time_s); };
    simulation::SimulatedScan measured = simulation::simulateFirings(
        course_.scene, filter_.sensor(), pose_at, kTurn_s * number, firings, random, faults_);
    maskAirframe(airframe_, measured.scan);
    return measured;
}

const LabelledReturns& TrialSensor::segment(int number, const simulation::SimulatedScan& measured,
                                            const FlightTrace& trace, PoseBelief& belief) {
    const simulation::SensorPose middle = belief.at(trace, kTurn_s * (number + 0.5));
    return filter_.segment(measured.scan, tiltOf(middle.attitude)).returns;
}

observations::MappedScan TrialSensor::place(int number, const simulation::SimulatedScan& measured,
                                            const LabelledReturns& returns,
                                            const FlightTrace& trace, PoseBelief& belief) {
    const double start_s = kTurn_s * number;
    const TurnTransforms transforms(start_s, trace, belief);
    const Scan& scan = measured.scan;
    observations::MappedScan placed;
    placed.time_s = start_s + kTurn_s;
    placed.origin_m = belief.at(trace, start_s + 0.5 * kTurn_s).position_m.cast<float>();
    placed.points_m.reserve(scan.size());
    placed.labels.reserve(scan.size());
    placed.obstacles.reserve(scan.size());
    placed.age_s.reserve(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (returns.label[i] == Label::Unclassified) continue;
        placed.points_m.push_back(
            transforms.place({scan.x_m[i], scan.y_m[i], scan.z_m[i]}, scan.time_s[i]));
        placed.labels.push_back(returns.label[i]);
        placed.obstacles.push_back(returns.component.empty() ? 0 : returns.component[i]);
        placed.age_s.push_back(static_cast<float>(kTurn_s) - scan.time_s[i]);
    }
    return placed;
}

}  // namespace hagen::avoidance
