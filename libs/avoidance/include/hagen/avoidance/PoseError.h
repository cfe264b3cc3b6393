#pragma once
#include <string>

namespace hagen::avoidance {

/// How the pose that a vehicle believes in differs from its true one; PoseBelief.h has the figures.
enum class PoseError { None, Noise, Drift };

/// "none", "noise", "drift".
std::string nameOf(PoseError error);
/// Throws std::invalid_argument, naming the known ones.
PoseError poseErrorFrom(const std::string& name);

}  // namespace hagen::avoidance
