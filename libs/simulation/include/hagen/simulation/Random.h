#pragma once
#include <cstdint>
#include <random>

namespace hagen::simulation {

/// Random numbers that are identical on every machine: a Mersenne twister with custom
/// distributions, because the standard library's differ between implementations.
class Random {
 public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Creates one of several independent random streams from a seed.
    Random(std::uint64_t seed, std::uint64_t stream);

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< [0, 1)
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Returns a uniform integer in 0 .. count - 1.
    int uniformInt(int count) { return static_cast<int>(uniform() * count); }
    bool chance(double probability) { return uniform() < probability; }
    double normal();  ///< mean 0, standard deviation 1
    /// Like normal(), but bounded by +-3.5: a sum of four uniform numbers, several times faster.
    double approximateNormal();
    double exponential(double mean);
    int poisson(double mean);

 private:
    std::mt19937_64 engine_;
};

}  // namespace hagen::simulation
