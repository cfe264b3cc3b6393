#include "filter/paper/SeedGate.h"
#include <gtest/gtest.h>

#include <algorithm>

#include "support/Random.h"

namespace hagen {
namespace {

/// Whether the lowest pixel of a single column remains a seed.
bool passes(const std::vector<float>& column_m, float angle_rad, float gate_rad = 0.5f) {
    const auto rows = static_cast<Eigen::Index>(column_m.size());
    Image<float> depth_m(rows, 1), pixel_angle_rad = Image<float>::Zero(rows, 1);
    std::copy(column_m.begin(), column_m.end(), depth_m.data());
    pixel_angle_rad(0, 0) = angle_rad;
    std::vector<int> seeds{0};
    gateSeeds(depth_m, pixel_angle_rad, gate_rad, seeds);
    return !seeds.empty();
}

TEST(SeedGate, NeedsLevelSeedBelowFartherPixel) {
    EXPECT_TRUE(passes({5, 8, 20}, 0.0f));
    EXPECT_TRUE(passes({5, 8, 20}, 0.499f));
    EXPECT_FALSE(passes({5, 8, 20}, 0.5f));
    EXPECT_FALSE(passes({5, 8, 20}, kNoValue));
    EXPECT_FALSE(passes({5, 4.9f, 20}, 0.0f));
    EXPECT_FALSE(passes({5, 5, 20}, 0.0f));
    EXPECT_TRUE(passes({5, kNoValue, 8}, 0.0f));
    EXPECT_FALSE(passes({5, kNoValue, 4}, 0.0f));
    EXPECT_FALSE(passes({5}, 0.0f));
    EXPECT_FALSE(passes({5, kNoValue, kNoValue}, 0.0f));
}

TEST(SeedGate, JudgesColumnsIndependently) {
    Image<float> depth_m(2, 3);
    depth_m << 5, 6, 7,  //
        kNoValue, 8, 9;
    std::vector<int> seeds{4, 0, 2};
    gateSeeds(depth_m, Image<float>::Zero(2, 3), 0.5f, seeds);
    EXPECT_EQ(seeds, (std::vector<int>{4, 2}));
}

}  // namespace
}  // namespace hagen
