#pragma once
#include <vector>

namespace hagen::base {

/// Returns the quantile of a fraction (0 to 1), interpolated between ranks; NaN without values.
double quantile(std::vector<double> values, double share);
/// The same for values in ascending order, at least one.
double quantileOfSorted(const std::vector<double>& ascending, double share);

/// Returns the smallest value that a fraction (0 to 1) of the values does not exceed (nearest
/// rank); values in ascending order, at least one.
double nearestRankOfSorted(const std::vector<double>& ascending, double share);

}  // namespace hagen::base
