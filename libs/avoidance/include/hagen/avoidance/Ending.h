#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/TrialResult.h>
#include <Eigen/Core>
#include <string>

namespace hagen::avoidance {

/// How a flight ended: "hit a tree at 7.42 s: 0.28 m from the vehicle's centre".
/// `speed_m_s` is the maximum speed of the run, `end_m` the vehicle's last position.
std::string endingOf(const avoidance::Course& course, const avoidance::TrialResult& result,
                     double speed_m_s, const Eigen::Vector3d& end_m);

}  // namespace hagen::avoidance
