#include "base/Quantile.h"
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hagen::base {

double quantileOfSorted(const std::vector<double>& ascending, double share) {
    const double rank = share * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    const double weight = rank - static_cast<double>(below);
    return ascending[below] + weight * (ascending[above] - ascending[below]);
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    return quantileOfSorted(values, share);
}

double nearestRankOfSorted(const std::vector<double>& ascending, double share) {
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(ascending.size())));
    return ascending[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace hagen::base
