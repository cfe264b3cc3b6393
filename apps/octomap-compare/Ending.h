#pragma once
#include <hagen/trials/Trial.h>
#include <Eigen/Core>
#include <string>

namespace hagen {

/// How a flight ended, in words: "hit a tree at 7.42 s: 0.28 m from it to the vehicle's middle".
/// `end_m` is where the vehicle was then.
std::string endingOf(const Course& course, const TrialResult& result, const Eigen::Vector3d& end_m);

}  // namespace hagen
