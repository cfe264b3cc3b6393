#include "base/NumberText.h"
#include <gtest/gtest.h>
#include <cstdint>
#include <limits>
#include <random>
#include "base/Text.h"

namespace hagen::base {
namespace {

TEST(NumberText, CountsUsePlural) {
    EXPECT_EQ(counted(0, "scan") + counted(1, "scan") + counted(2, "scan"), "0 scans1 scan2 scans");
    EXPECT_EQ(counted(2, "entry", "entries"), "2 entries");
    EXPECT_EQ(didYouMean("VLP16", {"HDL-32E", "VLP-16"}), "; did you mean 'VLP-16'?");
    EXPECT_EQ(didYouMean("a", {}), "");
}

TEST(NumberText, ShortestTextRoundTrips) {
    EXPECT_EQ(shortestText(0.1), "0.1");
    EXPECT_EQ(shortestText(0.1f), "0.1");
    EXPECT_EQ(shortestText(4.0), "4");
    std::mt19937_64 random(1);
    for (int i = 0; i < 1000; ++i) {
        const double value = std::ldexp(static_cast<double>(random()), static_cast<int>(i) - 500);
        EXPECT_EQ(numberFrom<double>(shortestText(value)), value);
    }
}

TEST(NumberText, FixedTextHasNoNegativeZero) {
    EXPECT_EQ(fixedText(1.005, 1), "1.0");
    EXPECT_EQ(fixedText(-0.04, 1), "0.0");
    EXPECT_EQ(fixedText(-0.06, 1), "-0.1");
    EXPECT_EQ(fixedText(-0.0, 0), "0");
    EXPECT_EQ(fixedText(std::numeric_limits<double>::max(), 2).size(), 309u + 3u);
}

TEST(NumberText, ParsesWholeTextOnly) {
    EXPECT_EQ(numberFrom<int>("-12"), -12);
    EXPECT_EQ(numberFrom<double>("1e3"), 1000.0);
    for (const char* text : {"", " 1", "1 ", "1x", "x", "1,5", "+1", "0x10"}) {
        EXPECT_EQ(numberFrom<double>(text), std::nullopt) << "'" << text << "'";
    }
    EXPECT_EQ(numberFrom<std::uint16_t>("65536"), std::nullopt);
    EXPECT_EQ(numberFrom<std::uint16_t>("-1"), std::nullopt);
}

TEST(NumberText, ParsesNumberPairs) {
    EXPECT_EQ(numbersFrom<int>("12-34", '-'), std::pair(12, 34));
    EXPECT_EQ(numbersFrom<int>("1/4", '/'), std::pair(1, 4));
    for (const char* text : {"", "-", "12", "12-", "-34", "12-34-56", "12 - 34"}) {
        EXPECT_EQ(numbersFrom<unsigned>(text, '-'), std::nullopt) << "'" << text << "'";
    }
    EXPECT_EQ(numbersFrom<int>("4294967297/4294967298", '/'), std::nullopt);
}

TEST(NumberText, PercentTextRoundsDown) {
    EXPECT_EQ(percentText(1.0f), "100.0 %");
    EXPECT_EQ(percentText(0.9999f), "99.9 %");
    EXPECT_EQ(percentText(0.5f), "50.0 %");
    EXPECT_EQ(percentText(0.00099f), "0.0 %");
}

}  // namespace
}  // namespace hagen::base
