#pragma once
#include <cstdint>
#include <random>

namespace hagen::simulation {

/// Random numbers that are identical on every machine: a Mersenne twister with our own
/// distributions, because those of the standard library differ between implementations.
class Random {
 public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Creates an independent stream for one part of what a seed generates, so that a change in one
    /// part does not shift the numbers of the others.
    Random(std::uint64_t seed, std::uint64_t stream);

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< [0, 1)
    double uniform(double least, double most) { return least + (most - least) * uniform(); }
    /// Returns a uniform integer in 0 .. count - 1.
    int uniformInt(int count) { return static_cast<int>(uniform() * count); }
    bool chance(double probability) { return uniform() < probability; }
    double normal();  ///< mean 0, standard deviation 1
    /// Mean 0 and standard deviation 1 as well, never beyond 3.5: a sum of four uniform numbers,
    /// several times as fast as normal().
    double approximateNormal();
    double exponential(double mean);
    /// Returns a Poisson-distributed count of rare independent events with this mean.
    int poisson(double mean);

 private:
    std::mt19937_64 engine_;
};

}  // namespace hagen::simulation
