#include "filter/image/GapRepair.h"
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/Random.h"

namespace hagen {
namespace {

Image<float> column(const std::vector<float>& values) {
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

TEST(GapRepair, FillsOnlyOnePixelHoles) {
    constexpr float kNo = kNoValue;
    const std::pair<std::vector<float>, std::vector<float>> cases[] = {
        {{10, kNo, 10.5f}, {10, 10.25f, 10.5f}},
        {{10, kNo, 11}, {10, kNo, 11}},            // too different
        {{10, kNo, kNo, 10}, {10, kNo, kNo, 10}},  // two missing pixels
        {{10, kNo, 10.5f, kNo, 11, kNo, kNo}, {10, 10.25f, 10.5f, 10.75f, 11, kNo, kNo}},
        {{kNo, 10, kNo}, {kNo, 10, kNo}},  // outermost rows
        {{kNo, kNo, kNo}, {kNo, kNo, kNo}}};
    for (const auto& [before, after] : cases) {
        EXPECT_TRUE(test::same(repaired(column(before), 1.0f), column(after)));
        EXPECT_TRUE(test::same(repaired(column(before), 0.0f), column(before)));  // disabled
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

}  // namespace
}  // namespace hagen
