#include <hagen/base/Quantile.h>
#include <hagen/simulation/Random.h>
#include <hagen/trials/Statistics.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hagen::trials {
namespace {

/// The standard normal deviate of a two-sided level: where the distribution function is
/// (1 + level) / 2. Newton's steps on the error function.
double normalDeviate(double level) {
    if (!(level > 0 && level < 1)) {
        throw std::invalid_argument("a level is between 0 and 1: " + std::to_string(level));
    }
    double z = 1;
    for (int step = 0; step < 60; ++step) {
        const double density = std::exp(-z * z / 2) * 2 / std::sqrt(2 * M_PI);
        z += std::clamp((level - std::erf(z / std::sqrt(2.0))) / density, -1.0, 1.0);
    }
    return z;
}

double medianOf(std::vector<double>& values) {
    const std::size_t half = values.size() / 2;
    std::nth_element(values.begin(), values.begin() + half, values.end());
    const double upper = values[half];
    if (values.size() % 2 == 1) return upper;
    return (*std::max_element(values.begin(), values.begin() + half) + upper) / 2;
}

/// The correlation of two paired outcomes as Newcombe takes it: of positive ones the numerator is
/// corrected for continuity by n / 2, but not beyond 0.
double correctedPhi(double both, double only_first, double only_second, double neither) {
    const double n = both + only_first + only_second + neither;
    const double product = (both + only_first) * (only_second + neither) * (both + only_second) *
                           (only_first + neither);
    if (product == 0) return 0;
    const double numerator = both * neither - only_first * only_second;
    return (numerator > 0 ? std::max(numerator - n / 2, 0.0) : numerator) / std::sqrt(product);
}

}  // namespace

Bounds wilsonInterval(int successes, int trials, double level) {
    if (trials == 0) return {0, 1};
    const double z2 = std::pow(normalDeviate(level), 2), n = trials, share = successes / n;
    const double middle = share + z2 / (2 * n);
    const double half = std::sqrt(z2 * (share * (1 - share) / n + z2 / (4 * n * n)));
    const double low = (middle - half) / (1 + z2 / n), high = (middle + half) / (1 + z2 / n);
    // Exactly 0 and 1 where rounding would leave a little.
    return {successes == 0 ? 0 : low, successes == trials ? 1 : high};
}

double mcNemar(int only_first, int only_second) {
    const int n = only_first + only_second, rarer = std::min(only_first, only_second);
    double tail = 0;
    for (int k = 0; k <= rarer; ++k) {
        tail += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) -
                         n * std::log(2.0));
    }
    return std::min(1.0, 2 * tail);
}

double leastMcNemar(int discordant) { return std::min(1.0, std::ldexp(1.0, 1 - discordant)); }

Bounds pairedDifferenceInterval(int both, int only_first, int only_second, int neither,
                                double level) {
    const int n = both + only_first + only_second + neither;
    if (n == 0) return {-1, 1};
    const double first = static_cast<double>(both + only_first) / n;
    const double second = static_cast<double>(both + only_second) / n;
    const Bounds of_first = wilsonInterval(both + only_first, n, level);
    const Bounds of_second = wilsonInterval(both + only_second, n, level);
    const double phi = correctedPhi(both, only_first, only_second, neither);
    const auto distance = [&](double a, double b) {
        return std::sqrt(std::max(0.0, a * a - 2 * phi * a * b + b * b));
    };
    const double difference = first - second;
    return {difference - distance(first - of_first.low, of_second.high - second),
            difference + distance(of_first.high - first, second - of_second.low)};
}

std::vector<double> holm(const std::vector<double>& p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> adjusted(p.size());
    double so_far = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        so_far = std::max(so_far, static_cast<double>(p.size() - rank) * p[order[rank]]);
        adjusted[order[rank]] = std::min(1.0, so_far);
    }
    return adjusted;
}

std::vector<double> holmOfAttainable(const std::vector<double>& p,
                                     const std::vector<double>& least_p, double level) {
    if (p.size() != least_p.size()) {
        throw std::invalid_argument(std::to_string(p.size()) + " values of p but " +
                                    std::to_string(least_p.size()) + " least values");
    }
    // A comparison that can never be rejected adds nothing to the chance of a false rejection, so
    // it need not be paid for (Tarone 1990). The choice looks only at the number of discordant
    // pairs. The exact test is conditional on that number, which under no difference says nothing
    // about the side they fall on, so the choice leaves every p valid.
    std::vector<std::size_t> kept;
    std::vector<double> p_of_kept;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!(least_p[i] < level)) continue;
        kept.push_back(i);
        p_of_kept.push_back(p[i]);
    }
    const std::vector<double> adjusted_of_kept = holm(p_of_kept);
    std::vector<double> adjusted(p.size(), NAN);
    for (std::size_t k = 0; k < kept.size(); ++k) adjusted[kept[k]] = adjusted_of_kept[k];
    return adjusted;
}

Bounds medianInterval(const std::vector<double>& values, int resamples, std::uint64_t seed,
                      double level) {
    if (values.empty() || resamples < 1) return {NAN, NAN};
    simulation::Random random(seed);
    std::vector<double> medians(static_cast<std::size_t>(resamples)), drawn(values.size());
    for (double& median : medians) {
        for (double& value : drawn)
            value = values[random.uniformInt(static_cast<int>(values.size()))];
        median = medianOf(drawn);
    }
    return {base::quantile(medians, (1 - level) / 2), base::quantile(medians, (1 + level) / 2)};
}

}  // namespace hagen::trials
