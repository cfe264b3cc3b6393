#include <hagen/scan/Angle.h>
#include <hagen/simulation/Random.h>
#include <cmath>

namespace hagen::simulation {

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : engine_(seed * 0x9e3779b97f4a7c15u + stream * 0xd1b54a32d192ed03u + 1) {}

double Random::normal() {  // Box-Muller; discards the second number
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
}

double Random::approximateNormal() {
    const std::uint64_t bits = engine_();  // the sum of four has variance 4/12 range^2
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += static_cast<double>(bits >> (16 * i) & 0xffff);
    return (sum * 0x1p-16 - (2.0 - 0x1p-15)) * 1.7320508075688772;
}

double Random::exponential(double mean) { return -mean * std::log(1.0 - uniform()); }

int Random::poisson(double mean) {
    int events = 0;
    for (double at = exponential(1.0); at < mean; at += exponential(1.0)) ++events;
    return events;
}

}  // namespace hagen::simulation
