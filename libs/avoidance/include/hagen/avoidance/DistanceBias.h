#pragma once
#include <string>

namespace hagen::avoidance {

/// How much larger than the true one a model's clearance is on average [m], as measured by
/// `octomap-compare distances`. 0 for models that know the truth. Throws std::invalid_argument for
/// a model that was not measured.
float distanceBias_m(const std::string& model);

}  // namespace hagen::avoidance
