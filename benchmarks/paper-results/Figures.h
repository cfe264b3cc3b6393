// The figures of the comparison.
#pragma once
#include <filesystem>
#include <vector>

#include "Measurement.h"

namespace hagen {

/// Draws into an existing folder
///
///     by_scan.svg          F1 of RoI of each scan, one line per method
///     by_returns.svg       run time over the number of returns, one point per scan
///     operating_curve.svg  precision over recall of RoI on real scans, also of tuned baselines
///
/// for the filters and the published baselines. Throws std::runtime_error like Drawing::draw().
void drawResults(const std::filesystem::path& folder, const std::vector<Measured>& scores,
                 const std::vector<Measured>& times);

}  // namespace hagen
