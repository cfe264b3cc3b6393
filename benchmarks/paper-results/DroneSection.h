// The sections of docs/results.md and README.md on what matters to a drone.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"

namespace hagen {

/// For each data set, all methods; then what `default` misses, by range and by class.
std::string droneSection(const std::vector<Measured>& all);

}  // namespace hagen
