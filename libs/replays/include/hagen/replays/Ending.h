#pragma once
#include <hagen/trials/Course.h>
#include <hagen/trials/TrialResult.h>
#include <Eigen/Core>
#include <string>

namespace hagen::replays {

/// How a flight ended, in words: "hit a tree at 7.42 s: 0.28 m from it to the vehicle's middle".
/// `speed_m_s` is the speed that the flight was to have, `end_m` where the vehicle was then.
std::string endingOf(const trials::Course& course, const trials::TrialResult& result,
                     double speed_m_s, const Eigen::Vector3d& end_m);

}  // namespace hagen::replays
