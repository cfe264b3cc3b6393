#include <hagen/observations/Settings.h>
#include <hagen/trials/TrialSensor.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "Streams.h"

namespace hagen::trials {
namespace {

HagenFilter standardFilter() {
    const observations::Settings
        settings;  // those of config/vlp16.yaml hold where no file was read
    return observations::filterFor(settings.sensorModel(), settings.options);
}

/// The inverse of levelFromSensor(): roll and pitch of an attitude without its heading.
Attitude tiltOf(const Eigen::Quaterniond& attitude) {
    const Eigen::Vector3d up = attitude.conjugate() * Eigen::Vector3d::UnitZ();
    return {static_cast<float>(std::atan2(up.y(), up.z())),
            static_cast<float>(std::asin(std::clamp(-up.x(), -1.0, 1.0)))};
}

/// Believed poses during a turn, as matrices that are straight between.
class TurnTransforms {
 public:
    TurnTransforms(double start_s, const FlightTrace& trace, PoseBelief& belief) {
        for (int step = 0; step <= kSteps + 1; ++step) {
            const simulation::SensorPose pose = belief.at(trace, start_s + step * kStep_s);
            Eigen::Matrix<float, 3, 4> matrix;
            matrix << pose.attitude.toRotationMatrix().cast<float>(), pose.position_m.cast<float>();
            poses_[step] = matrix;
        }
    }
    Eigen::Vector3f place(const Eigen::Vector3f& point_m, float since_start_s) const {
        const float at = std::clamp(since_start_s / static_cast<float>(kStep_s), 0.0f,
                                    static_cast<float>(kSteps));
        const auto before = static_cast<std::size_t>(at);
        const float share = at - static_cast<float>(before);
        const Eigen::Matrix<float, 3, 4> matrix =
            poses_[before] + share * (poses_[before + 1] - poses_[before]);
        return matrix * point_m.homogeneous();
    }

 private:
    static constexpr int kSteps = 20;
    static constexpr double kStep_s = TrialSensor::kTurn_s / kSteps;
    std::array<Eigen::Matrix<float, 3, 4>, kSteps + 2> poses_;
};

}  // namespace

TrialSensor::TrialSensor(const Course& course, Air air)
    : course_(course),
      faults_(trialErrorModel(air)),
      airframe_(trialAirframe(air)),
      filter_(standardFilter()) {}

simulation::SimulatedScan TrialSensor::measure(int number, const FlightTrace& trace) const {
    simulation::Random random(course_.seed, streams::kScan + static_cast<std::uint64_t>(number));
    const auto pose_at = [&](double time_s) { return trace.at(time_s); };
    simulation::SimulatedScan measured = simulation::simulateScan(
        course_.scene, filter_.sensor(), pose_at, kTurn_s * number, random, faults_);
    maskAirframe(airframe_, measured.scan);
    return measured;
}

const LabelledReturns& TrialSensor::segment(int number, const simulation::SimulatedScan& measured,
                                            const FlightTrace& trace, PoseBelief& belief) {
    const simulation::SensorPose middle = belief.at(trace, kTurn_s * (number + 0.5));
    return filter_.segment(measured.scan, tiltOf(middle.attitude)).returns;
}

mapping::MappedScan TrialSensor::place(int number, const simulation::SimulatedScan& measured,
                                       const LabelledReturns& returns, const FlightTrace& trace,
                                       PoseBelief& belief) {
    const double start_s = kTurn_s * number;
    const TurnTransforms transforms(start_s, trace, belief);
    const Scan& scan = measured.scan;
    mapping::MappedScan placed;
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
        placed.obstacles.push_back(returns.component[i]);
        placed.age_s.push_back(static_cast<float>(kTurn_s) - scan.time_s[i]);
    }
    return placed;
}

}  // namespace hagen::trials
