#pragma once
#include <hagen/avoidance/ModelDistance.h>
#include <string>

namespace hagen::avoidance {

using avoidance::ModelDistance;

/// "unbiased" or "as-stored". Throws std::invalid_argument, naming them, for any other.
ModelDistance distanceFrom(const std::string& name);

}  // namespace hagen::avoidance
