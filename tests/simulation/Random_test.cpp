#include <gtest/gtest.h>
#include <hagen/simulation/Random.h>

#include <cmath>
#include <functional>

namespace hagen::simulation {
namespace {

struct Moments {
    double mean, variance;
};
Moments momentsOf(const std::function<double()>& draw) {
    constexpr int kCount = 100000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kCount; ++i) {
        const double value = draw();
        sum += value;
        squares += value * value;
    }
    return {sum / kCount, squares / kCount - sum * sum / (double{kCount} * kCount)};
}

TEST(RandomTest, TheSameSeedMakesTheSameNumbersOnEveryMachine) {
    Random random(42);  // a Mersenne twister's first output for this seed, 53 bits of it
    EXPECT_DOUBLE_EQ(random.uniform(), static_cast<double>(13930160852258120406u >> 11) * 0x1p-53);
}

TEST(RandomTest, StreamsOfASeedDiffer) {
    EXPECT_NE(Random(1, 1).uniform(), Random(1, 2).uniform());
    EXPECT_NE(Random(1, 1).uniform(), Random(2, 1).uniform());
    EXPECT_EQ(Random(1, 1).uniform(), Random(1, 1).uniform());
}

TEST(RandomTest, DistributionsHaveTheirMoments) {
    Random random(7);
    const Moments uniform = momentsOf([&] { return random.uniform(2, 5); });
    EXPECT_NEAR(uniform.mean, 3.5, 0.01);
    EXPECT_NEAR(uniform.variance, 9.0 / 12, 0.01);
    const Moments normal = momentsOf([&] { return random.normal(); });
    EXPECT_NEAR(normal.mean, 0, 0.01);
    EXPECT_NEAR(normal.variance, 1, 0.02);
    const Moments roughly = momentsOf([&] { return random.approximateNormal(); });
    EXPECT_NEAR(roughly.mean, 0, 0.01);
    EXPECT_NEAR(roughly.variance, 1, 0.02);
    const Moments exponential = momentsOf([&] { return random.exponential(3); });
    EXPECT_NEAR(exponential.mean, 3, 0.05);
    EXPECT_NEAR(exponential.variance, 9, 0.4);
    const Moments poisson = momentsOf([&] { return random.poisson(4); });
    EXPECT_NEAR(poisson.mean, 4, 0.05);
    EXPECT_NEAR(poisson.variance, 4, 0.15);
}

TEST(RandomTest, BelowStaysBelow) {
    Random random(3);
    bool has_least = false, has_most = false;
    for (int i = 0; i < 1000; ++i) {
        const int value = random.uniformInt(5);
        ASSERT_GE(value, 0);
        ASSERT_LT(value, 5);
        has_least |= value == 0;
        has_most |= value == 4;
    }
    EXPECT_TRUE(has_least && has_most);
}

}  // namespace
}  // namespace hagen::simulation
