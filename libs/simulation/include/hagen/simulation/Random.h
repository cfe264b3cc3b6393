#pragma once
#include <cstdint>
#include <random>

namespace hagen::simulation {

/// Random numbers that are the same on every machine: those of a Mersenne twister, with
/// distributions of our own, for the standard library's differ from one to the next.
class Random {
 public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// A stream of its own for a part of what a seed makes, so that parts do not shift one another.
    Random(std::uint64_t seed, std::uint64_t stream);

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< [0, 1)
    double uniform(double least, double most) { return least + (most - least) * uniform(); }
    /// 0 .. count - 1.
    int below(int count) { return static_cast<int>(uniform() * count); }
    bool chance(double probability) { return uniform() < probability; }
    double normal();  ///< mean 0, standard deviation 1
    /// The same moments, never beyond 3.5: a sum of four numbers, several times as fast.
    double roughlyNormal();
    double exponential(double mean);
    /// How many of rare independent events happen, where `mean` are expected.
    int poisson(double mean);

 private:
    std::mt19937_64 engine_;
};

}  // namespace hagen::simulation
