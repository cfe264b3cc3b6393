#pragma once
#include <hagen/trials/Course.h>
#include <hagen/trials/TrialResult.h>
#include <Eigen/Core>
#include <string>

namespace hagen::replays {

/// How a flight ended: "hit a tree at 7.42 s: 0.28 m from the vehicle's centre".
/// `speed_m_s` is the maximum speed of the run, `end_m` the vehicle's last position.
std::string endingOf(const trials::Course& course, const trials::TrialResult& result,
                     double speed_m_s, const Eigen::Vector3d& end_m);

}  // namespace hagen::replays
