// Against published examples, and against sums and searches that need no formula.
#include <gtest/gtest.h>
#include <hagen/base/Quantile.h>
#include <hagen/simulation/Random.h>
#include <hagen/trials/Statistics.h>

#include <algorithm>
#include <cmath>

namespace hagen::trials {
namespace {

void expectBounds(Bounds bounds, double low, double high, double tolerance = 0.00005001) {
    EXPECT_NEAR(bounds.low, low, tolerance);
    EXPECT_NEAR(bounds.high, high, tolerance);
}

// R. G. Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine
// 17 (1998) 857-872, table I, method 3.
TEST(WilsonInterval, IsThatOfNewcombesTable) {
    expectBounds(wilsonInterval(81, 263), 0.2553, 0.3662);
    expectBounds(wilsonInterval(15, 148), 0.0624, 0.1605);
    expectBounds(wilsonInterval(0, 20), 0, 0.1611);
    expectBounds(wilsonInterval(1, 29), 0.0061, 0.1718);
}

TEST(WilsonInterval, NoneOf200StillAllowsNearly2Percent) {
    const Bounds bounds = wilsonInterval(0, 200);
    EXPECT_EQ(bounds.low, 0);
    EXPECT_NEAR(bounds.high, 0.0188, 0.00005);
}

TEST(WilsonInterval, EndsWhereTheScoreTestWouldJustNotReject) {
    simulation::Random random(1);
    for (int i = 0; i < 200; ++i) {
        const int n = 1 + random.uniformInt(400);
        const int k = random.uniformInt(n + 1);
        const Bounds bounds = wilsonInterval(k, n, 0.9);
        for (const double share : {bounds.low, bounds.high}) {
            if (share == 0 || share == 1) continue;
            const double z = std::abs(k - n * share) / std::sqrt(n * share * (1 - share));
            EXPECT_NEAR(z, 1.6448536, 1e-6) << k << " of " << n;
        }
        const Bounds mirrored = wilsonInterval(n - k, n, 0.9);
        EXPECT_NEAR(mirrored.low, 1 - bounds.high, 1e-12);
    }
}

TEST(WilsonInterval, SaysNothingOfNoTrials) {
    EXPECT_EQ(wilsonInterval(0, 0).low, 0);
    EXPECT_EQ(wilsonInterval(0, 0).high, 1);
    EXPECT_THROW(wilsonInterval(1, 2, 1.0), std::invalid_argument);
}

TEST(McNemar, IsTwiceTheTailOfTossedCoins) {
    EXPECT_EQ(mcNemar(0, 0), 1);
    EXPECT_EQ(mcNemar(3, 3), 1);
    EXPECT_NEAR(mcNemar(0, 5), 2 / 32.0, 1e-12);
    EXPECT_NEAR(mcNemar(1, 9), 2 * (1 + 10) / 1024.0, 1e-12);
    EXPECT_NEAR(mcNemar(9, 1), mcNemar(1, 9), 1e-15);
    // Enumerated: how many of 2^12 sequences are at least as lopsided.
    int lopsided = 0;
    for (int tosses = 0; tosses < 4096; ++tosses) {
        const int heads = __builtin_popcount(static_cast<unsigned>(tosses));
        if (heads <= 3 || heads >= 9) ++lopsided;
    }
    EXPECT_NEAR(mcNemar(3, 9), lopsided / 4096.0, 1e-12);
    EXPECT_NEAR(mcNemar(9, 3), lopsided / 4096.0, 1e-12);
}

// Fagerland, Lydersen, Laake, Statistical Analysis of Contingency Tables (2017), chapter 8.
TEST(McNemar, IsThatOfAPublishedExample) { EXPECT_NEAR(mcNemar(6, 16), 0.052479, 5e-7); }

TEST(McNemar, KeepsItsDigitsForManyPairs) {
    // The normal distribution's tail, continuity corrected: z = (|b - c| - 1) / sqrt(b + c).
    const double z = (5200 - 4800 - 1) / std::sqrt(10000.0);
    EXPECT_NEAR(mcNemar(4800, 5200), std::erfc(z / std::sqrt(2.0)), 1e-6);
    EXPECT_GT(mcNemar(0, 1000), 0);
}

// R. G. Newcombe, Improved confidence intervals for the difference between binomial proportions
// based on paired data, Statistics in Medicine 17 (1998) 2635-2650, method 10; and the response to
// a therapy (Cavo 2012) in Fagerland, Lydersen, Laake, Statistical Analysis of Contingency Tables
// (2017), chapter 8.
TEST(PairedDifference, IsThatOfPublishedExamples) {
    expectBounds(pairedDifferenceInterval(36, 12, 2, 0), 0.0569, 0.3404);
    expectBounds(pairedDifferenceInterval(59, 6, 16, 80), -0.1186, -0.0046);
}

TEST(PairedDifference, WithoutCorrelationIsThatOfIndependentShares) {
    // Products of margins: phi is 0. Newcombe's method for independent shares is the square root
    // of the sum of squares.
    const int both = 24, first = 16, second = 36, neither = 24;
    const Bounds a = wilsonInterval(both + first, 100), b = wilsonInterval(both + second, 100);
    const Bounds bounds = pairedDifferenceInterval(both, first, second, neither);
    EXPECT_NEAR(bounds.low, -0.2 - std::hypot(0.4 - a.low, b.high - 0.6), 1e-12);
    EXPECT_NEAR(bounds.high, -0.2 + std::hypot(a.high - 0.4, 0.6 - b.low), 1e-12);
}

TEST(PairedDifference, TurnsRoundWithItsSidesAndHoldsTheDifference) {
    simulation::Random random(3);
    for (int i = 0; i < 500; ++i) {
        const int a = random.uniformInt(60), b = random.uniformInt(20);
        const int c = random.uniformInt(20), d = random.uniformInt(60);
        const Bounds bounds = pairedDifferenceInterval(a, b, c, d);
        const Bounds turned = pairedDifferenceInterval(a, c, b, d);
        EXPECT_NEAR(bounds.low, -turned.high, 1e-12);
        EXPECT_GE(bounds.low, -1 - 1e-12);
        EXPECT_LE(bounds.high, 1 + 1e-12);
        const int n = a + b + c + d;
        if (n == 0) continue;
        EXPECT_LE(bounds.low, static_cast<double>(b - c) / n + 1e-12);
        EXPECT_GE(bounds.high, static_cast<double>(b - c) / n - 1e-12);
    }
}

TEST(PairedDifference, HoldsTheTrueDifferenceAsOftenAsItSays) {
    simulation::Random random(4);
    int held = 0;
    const int repetitions = 2000;
    for (int r = 0; r < repetitions; ++r) {
        int cells[4] = {0, 0, 0, 0};  // true shares .6 .2 .1 .1, difference .1
        for (int i = 0; i < 100; ++i) {
            const double at = random.uniform();
            ++cells[at < 0.6 ? 0 : at < 0.8 ? 1 : at < 0.9 ? 2 : 3];
        }
        const Bounds bounds = pairedDifferenceInterval(cells[0], cells[1], cells[2], cells[3]);
        if (bounds.low <= 0.1 && 0.1 <= bounds.high) ++held;
    }
    EXPECT_NEAR(held / double{repetitions}, 0.95, 0.015);
}

TEST(PairedDifference, SaysNothingOfNoPairs) {
    expectBounds(pairedDifferenceInterval(0, 0, 0, 0), -1, 1);
}

TEST(Holm, IsThatOfAPublishedExample) {
    // The worked example of Wikipedia's "Holm-Bonferroni method": .01 .04 .03 .005 -> H1 and H4
    // are rejected at 5 %.
    const std::vector<double> adjusted = holm({0.01, 0.04, 0.03, 0.005});
    EXPECT_NEAR(adjusted[0], 0.03, 1e-12);
    EXPECT_NEAR(adjusted[1], 0.06, 1e-12);
    EXPECT_NEAR(adjusted[2], 0.06, 1e-12);
    EXPECT_NEAR(adjusted[3], 0.02, 1e-12);
}

TEST(Holm, RejectsWhatTheStepDownRuleRejects) {
    simulation::Random random(5);
    for (int i = 0; i < 100; ++i) {
        std::vector<double> p;
        for (int k = 0; k < 7; ++k) p.push_back(std::pow(random.uniform(), 4));
        std::vector<double> ascending = p;
        std::sort(ascending.begin(), ascending.end());
        std::size_t rejected = 0;
        while (rejected < p.size() &&
               ascending[rejected] <= 0.05 / static_cast<double>(p.size() - rejected))
            ++rejected;
        const std::vector<double> adjusted = holm(p);
        EXPECT_EQ(
            std::count_if(adjusted.begin(), adjusted.end(), [](double q) { return q <= 0.05; }),
            static_cast<std::ptrdiff_t>(rejected));
    }
    EXPECT_TRUE(holm({}).empty());
    EXPECT_EQ(holm({0.9, 0.9}), (std::vector<double>{1, 1}));
}

TEST(McNemar, AttainsItsLeastPIfAllDiscordantPairsFallOnOneSide) {
    for (int n = 0; n <= 40; ++n) {
        double least = 1;
        for (int k = 0; k <= n; ++k) least = std::min(least, mcNemar(k, n - k));
        EXPECT_NEAR(leastMcNemar(n), least, 1e-12 * least) << n;
    }
    EXPECT_EQ(leastMcNemar(0), 1);
    EXPECT_GE(leastMcNemar(5), 0.05);  // 0.0625
    EXPECT_LT(leastMcNemar(6), 0.05);  // 0.03125
}

TEST(HolmOfAttainable, LeavesOutWhatCannotBeSignificant) {
    const std::vector<double> adjusted =
        holmOfAttainable({0.01, 1, 0.02, 0.0625, 0.05}, {0.001, 1, 0.01, 0.0625, 0.05});
    EXPECT_NEAR(adjusted[0], 0.02, 1e-12);  // of two, not of five
    EXPECT_TRUE(std::isnan(adjusted[1]));
    EXPECT_NEAR(adjusted[2], 0.02, 1e-12);
    EXPECT_TRUE(std::isnan(adjusted[3]));
    EXPECT_TRUE(std::isnan(adjusted[4]));  // not below the level
    EXPECT_FALSE(std::isnan(holmOfAttainable({0.05}, {0.05}, 0.1)[0]));
    EXPECT_TRUE(holmOfAttainable({}, {}).empty());
    EXPECT_THROW(holmOfAttainable({0.1}, {}), std::invalid_argument);
}

/// Without any difference, a family of 30 comparisons must not give a false finding more often than
/// in 5 % of the campaigns, although it is chosen by the same data.
TEST(HolmOfAttainable, KeepsTheErrorOfTheFamily) {
    simulation::Random random(6);
    int campaigns_with_findings = 0;
    const int campaigns = 4000;
    for (int c = 0; c < campaigns; ++c) {
        std::vector<double> p, least_p;
        for (int k = 0; k < 30; ++k) {
            const int discordant = random.uniformInt(14);
            int on_one_side = 0;
            for (int i = 0; i < discordant; ++i) on_one_side += random.uniformInt(2);
            p.push_back(mcNemar(on_one_side, discordant - on_one_side));
            least_p.push_back(leastMcNemar(discordant));
        }
        const std::vector<double> adjusted = holmOfAttainable(p, least_p);
        if (std::any_of(adjusted.begin(), adjusted.end(), [](double q) { return q < 0.05; })) {
            ++campaigns_with_findings;
        }
    }
    EXPECT_LE(campaigns_with_findings, 0.05 * campaigns);
    EXPECT_GT(campaigns_with_findings, 0);
}

TEST(Quantile, LiesBetweenRanks) {
    EXPECT_EQ(base::quantile({3, 1, 2}, 0.5), 2);
    EXPECT_EQ(base::quantile({4, 1, 2, 3}, 0.5), 2.5);
    EXPECT_EQ(base::quantile({4, 1, 2, 3}, 0), 1);
    EXPECT_EQ(base::quantile({4, 1, 2, 3}, 1), 4);
    EXPECT_NEAR(base::quantile({0, 10}, 0.95), 9.5, 1e-12);
    EXPECT_TRUE(std::isnan(base::quantile({}, 0.5)));
}

TEST(MedianInterval, IsNearlyThatOfOrderStatistics) {
    // Of 1..101 the median's 95 % interval by ranks (binomial, 1/2) is 41 to 61.
    std::vector<double> values;
    for (int v = 101; v >= 1; --v) values.push_back(v);
    expectBounds(medianInterval(values, 4000), 41, 61, 1.01);
    const Bounds again = medianInterval(values, 4000);
    EXPECT_EQ(again.low, medianInterval(values, 4000).low);
}

TEST(MedianInterval, OfOneValueIsThatValueAndOfNoneThereIsNone) {
    expectBounds(medianInterval({7}), 7, 7);
    EXPECT_TRUE(std::isnan(medianInterval({}).low));
}

}  // namespace
}  // namespace hagen::trials
