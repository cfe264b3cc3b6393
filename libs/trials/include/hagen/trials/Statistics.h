#pragma once
#include <cstdint>
#include <vector>

namespace hagen::trials {

struct Bounds {
    double low, high;
};

/// Wilson's score interval of a share (Wilson 1927), default: 95 %. No trials: 0 to 1.
Bounds wilsonInterval(int successes, int trials, double level = 0.95);

/// McNemar's exact test of paired outcomes: the two-sided p of `only_first` against `only_second`
/// discordant pairs (binomial, 1/2). 1 where there are none.
double mcNemar(int only_first, int only_second);

/// The least p that mcNemar() can give for this many discordant pairs: all of them on one side.
double leastMcNemar(int discordant);

/// Newcombe's interval (1998, method 10) of the difference of two paired shares, first - second.
Bounds pairedDifferenceInterval(int both, int only_first, int only_second, int neither,
                                double level = 0.95);

/// Holm's step-down correction (1979): adjusted p, in the order given.
std::vector<double> holm(const std::vector<double>& p);

/// Holm's correction over the comparisons that could be significant: those whose least attainable p
/// is below the level. NaN for the others, which count for nothing. `p` and `least_p` are in the
/// same order. Throws std::invalid_argument if their sizes differ.
std::vector<double> holmOfAttainable(const std::vector<double>& p,
                                     const std::vector<double>& least_p, double level = 0.05);

/// Percentile bootstrap of the median; NaN of no values.
Bounds medianInterval(const std::vector<double>& values, int resamples = 2000,
                      std::uint64_t seed = 1, double level = 0.95);

}  // namespace hagen::trials
