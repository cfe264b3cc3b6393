// The two figures of the comparison.
#pragma once
#include <filesystem>
#include <vector>

#include "Measurement.h"

namespace hagen {

/// Draws into a folder that exists
///
///     by_scan.svg      F1 of RoI of each scan, a line a method
///     by_returns.svg   run time over the number of returns, a point a scan
///
/// of the filters and the baselines as published. Throws std::runtime_error as runGnuplot() does.
void drawResults(const std::filesystem::path& folder, const std::vector<Measured>& scores,
                 const std::vector<Measured>& times);

}  // namespace hagen
