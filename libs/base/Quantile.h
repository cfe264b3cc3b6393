#pragma once
#include <vector>

namespace hagen::base {

/// Returns the quantile at a fraction (0 to 1), interpolated between ranks; NaN if there are no
/// values.
double quantile(std::vector<double> values, double share);
/// Like quantile(), for a non-empty series in ascending order.
double quantileOfSorted(const std::vector<double>& ascending, double share);

/// Returns the nearest-rank quantile at a fraction (0 to 1) of a non-empty series in ascending
/// order.
double nearestRankOfSorted(const std::vector<double>& ascending, double share);

}  // namespace hagen::base
