#pragma once
#include <hagen/filter/Levelling.h>
#include <Eigen/Core>
#include <array>
#include "avoidance/flights/FlightTrace.h"
#include "avoidance/flights/PoseBelief.h"

namespace hagen::avoidance {

/// Roll and pitch of an attitude: the inverse of levelFromSensor().
Attitude tiltOf(const Eigen::Quaterniond& attitude);

/// Estimated poses during a turn of the sensor, as linearly interpolated matrices. Until the turn
/// ends, only past poses are valid.
class TurnTransforms {
 public:
    TurnTransforms(double start_s, const FlightTrace& trace, PoseBelief& belief);

    /// Transforms a return to the map frame.
    Eigen::Vector3f place(const Eigen::Vector3f& point_m, float since_start_s) const;

 private:
    static constexpr int kSteps = 20;
    static constexpr double kStep_s = 0.1 / kSteps;  // kSteps per TrialSensor::kTurn_s
    std::array<Eigen::Matrix<float, 3, 4>, kSteps + 2> poses_;
};

}  // namespace hagen::avoidance
