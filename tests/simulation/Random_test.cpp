#include <gtest/gtest.h>
#include <hagen/simulation/Random.h>

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

TEST(RandomTest, MatchesMersenneTwister) {
    Random random(42);  // the first 53 bits of a Mersenne twister with this seed
    EXPECT_DOUBLE_EQ(random.uniform(), static_cast<double>(13930160852258120406u >> 11) * 0x1p-53);
}

TEST(RandomTest, StreamsDiffer) {
    EXPECT_NE(Random(1, 1).uniform(), Random(1, 2).uniform());
    EXPECT_NE(Random(1, 1).uniform(), Random(2, 1).uniform());
    EXPECT_EQ(Random(1, 1).uniform(), Random(1, 1).uniform());
}

TEST(RandomTest, DistributionsHaveExpectedMoments) {
    Random random(7);
    const auto expect = [](double mean, double variance, const std::function<double()>& draw) {
        const Moments found = momentsOf(draw);
        EXPECT_NEAR(found.mean, mean, 0.01 + 0.013 * mean);
        EXPECT_NEAR(found.variance, variance, 0.045 * variance);
    };
    expect(3.5, 9.0 / 12, [&] { return random.uniform(2, 5); });
    expect(0, 1, [&] { return random.normal(); });
    expect(0, 1, [&] { return random.approximateNormal(); });
    expect(3, 9, [&] { return random.exponential(3); });
    expect(4, 4, [&] { return random.poisson(4); });
}

TEST(RandomTest, IntegersStayBelowLimit) {
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
