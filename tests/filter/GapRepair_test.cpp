#include <gtest/gtest.h>
#include <hagen/filter/GapRepair.h>

#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

Image<float> column(std::initializer_list<float> values) {
    Image<float> image(values.size(), 1);
    int row = 0;
    for (const float value : values) image(row++, 0) = value;
    return image;
}

Image<float> repaired(const Image<float>& depth_m, float max_step_m) {
    Image<float> result;
    repairGaps(depth_m, max_step_m, result);
    return result;
}

TEST(GapRepair, FillsHoleWithMeanOfNeighbours) {
    EXPECT_TRUE(test::same(repaired(column({10.0f, kNoValue, 10.5f}), 1.0f),
                           column({10.0f, 10.25f, 10.5f})));
}

TEST(GapRepair, KeepsHoleBetweenDistantNeighbours) {
    const auto depth = column({10.0f, kNoValue, 11.0f});
    EXPECT_TRUE(test::same(repaired(depth, 1.0f), depth));
}

TEST(GapRepair, KeepsTwoPixelHole) {
    const auto depth = column({10.0f, kNoValue, kNoValue, 10.0f});
    EXPECT_TRUE(test::same(repaired(depth, 1.0f), depth));
}

TEST(GapRepair, IgnoresItsOwnOutput) {
    EXPECT_TRUE(test::same(
        repaired(column({10.0f, kNoValue, 10.5f, kNoValue, 11.0f, kNoValue, kNoValue}), 1.0f),
        column({10.0f, 10.25f, 10.5f, 10.75f, 11.0f, kNoValue, kNoValue})));
}

TEST(GapRepair, KeepsOutermostRows) {
    const auto depth = column({kNoValue, 10.0f, kNoValue});
    EXPECT_TRUE(test::same(repaired(depth, 1.0f), depth));
}

TEST(GapRepair, StepOfZeroDisablesRepair) {
    const auto depth = column({10.0f, kNoValue, 10.0f});
    EXPECT_TRUE(test::same(repaired(depth, 0.0f), depth));
}

TEST(GapRepair, KeepsPixelsWithDepth) {
    test::Random random(8);
    for (int round = 0; round < 20; ++round) {
        const Image<float> depth_m = random.image(16, 50, 1.0f, 5.0f, 0.4);
        const Image<float> after = repaired(depth_m, 1.0f);
        for (int pixel = 0; pixel < depth_m.size(); ++pixel) {
            if (hasValue(depth_m.data()[pixel])) {
                ASSERT_EQ(after.data()[pixel], depth_m.data()[pixel]);
            } else if (hasValue(after.data()[pixel])) {
                const float below = depth_m.data()[pixel - 1], above = depth_m.data()[pixel + 1];
                ASSERT_LT(std::abs(above - below), 1.0f);
                ASSERT_GE(after.data()[pixel], std::min(below, above));
                ASSERT_LE(after.data()[pixel], std::max(below, above));
            }
        }
    }
}

TEST(GapRepair, MatchesDefinition) {
    test::Random random(9);
    for (int round = 0; round < 100; ++round) {
        const Image<float> depth_m =
            random.image(random.whole(1, 40), random.whole(1, 30), 1.0f, 5.0f, 0.4);
        Image<float> expected = depth_m;
        for (int column = 0; column < depth_m.cols(); ++column) {
            for (int row = 1; row + 1 < depth_m.rows(); ++row) {
                if (hasValue(depth_m(row, column))) continue;
                const float below = depth_m(row - 1, column), above = depth_m(row + 1, column);
                if (std::abs(above - below) < 1.0f) expected(row, column) = 0.5f * (below + above);
            }
        }
        ASSERT_TRUE(test::same(repaired(depth_m, 1.0f), expected));
    }
}

TEST(GapRepair, EmptyImageStaysEmpty) {
    EXPECT_TRUE(repaired(Image<float>::Constant(16, 870, kNoValue), 1.0f).isNaN().all());
}

}  // namespace
}  // namespace hagen
