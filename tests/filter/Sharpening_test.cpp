#include "filter/paper/Sharpening.h"
#include <gtest/gtest.h>

#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

TEST(Sharpening, FollowsEquation) {
    Image<float> proximity_m = Image<float>::Constant(3, 5, kNoValue);
    proximity_m(1, 2) = 6.0f;
    proximity_m(1, 3) = 5.0f;  // edge neighbour
    proximity_m(0, 1) = 4.0f;  // diagonal
    Image<float> sharpened_m;
    sharpenMaxima(proximity_m, {{1, 2, 6.0f, 0.0f}}, 1.2f, 1.3f, sharpened_m);
    const double beside = std::exp(-0.5 / (1.2 * 1.2)) * std::exp(-0.5 / (1.3 * 1.3));
    const double diagonal = std::exp(-1.0 / (1.2 * 1.2)) * std::exp(-2.0 / (1.3 * 1.3));
    EXPECT_NEAR(sharpened_m(1, 2), 6 + (5 * beside + 4 * diagonal) / (beside + diagonal), 1e-5);
}

TEST(Sharpening, OwnValueDoublesMaximum) {
    test::Random random(14);
    for (int round = 0; round < 20; ++round) {
        Image<float> image_m = random.image(3, 5, 0.5f, 3.0f, 0.3);
        image_m(1, 2) = 4.0f;
        image_m(1, 3) = 3.5f;
        Image<float> sharpened_m;
        sharpenMaxima(image_m, {{1, 2, 4.0f, 0.0f}}, 1.2f, 1.3f, sharpened_m, false);
        ASSERT_NEAR(sharpened_m(1, 2), 8.0f, 1e-5f);
        sharpened_m(1, 2) = 4.0f;
        ASSERT_TRUE(test::same(sharpened_m, image_m));
    }
}

TEST(Sharpening, NeighboursWrapInAzimuth) {
    Image<float> proximity_m = Image<float>::Constant(3, 5, kNoValue);
    proximity_m(1, 0) = 6.0f;
    proximity_m(1, 4) = 6.0f;
    Image<float> sharpened_m;
    sharpenMaxima(proximity_m, {{1, 0, 6.0f, 0.0f}}, 1.2f, 1.3f, sharpened_m);
    EXPECT_FLOAT_EQ(sharpened_m(1, 0), 12.0f);
}

TEST(Sharpening, KeepsLoneMaximum) {
    Image<float> proximity_m = Image<float>::Constant(3, 5, kNoValue);
    proximity_m(1, 2) = 6.0f;
    Image<float> sharpened_m;
    for (const bool by_neighbours : {true, false}) {
        sharpenMaxima(proximity_m, {{1, 2, 6.0f, 0.0f}}, 1.2f, 1.3f, sharpened_m, by_neighbours);
        EXPECT_EQ(sharpened_m(1, 2), 6.0f);
    }
}

TEST(Sharpening, NegligibleWeightsStayFinite) {
    Image<float> proximity_m = Image<float>::Constant(3, 5, 0.0f);
    proximity_m(1, 2) = 900.0f;
    Image<float> sharpened_m;
    sharpenMaxima(proximity_m, {{1, 2, 900.0f, 0.0f}}, 1.2f, 1.3f, sharpened_m);
    EXPECT_EQ(sharpened_m(1, 2), 900.0f);
}

TEST(Merge, MovesNearerByHalf) {
    Image<float> depth_m = Image<float>::Constant(3, 5, 18.0f);
    Image<float> proximity_m = 20.0f - depth_m, sharpened_m = proximity_m, merged_m;
    sharpened_m(1, 2) = 2.0f + 3.0f;
    mergeMaxima(depth_m, proximity_m, sharpened_m, {{1, 2, 2.0f, 0.0f}}, 0.5f, merged_m);
    EXPECT_FLOAT_EQ(merged_m(1, 2), 16.5f);  // (2 + 5) / 2 = 3.5 in proximity
    merged_m(1, 2) = 18.0f;
    EXPECT_TRUE(test::same(merged_m, depth_m));
}

TEST(Merge, StopsAtMinimumRange) {
    const Image<float> depth_m = Image<float>::Constant(1, 5, 2.0f);
    Image<float> proximity_m = 20.0f - depth_m, sharpened_m, merged_m;
    const std::vector<Maximum> maxima{{0, 2, 18.0f, 0.0f}};
    sharpenMaxima(proximity_m, maxima, 1.2f, 1.3f, sharpened_m);
    mergeMaxima(depth_m, proximity_m, sharpened_m, maxima, 0.5f, merged_m);
    EXPECT_EQ(merged_m(0, 2), 0.5f);
}

TEST(Merge, DepthsMoveAway) {
    const Image<float> depth_m = Image<float>::Constant(3, 5, 6.0f);
    const std::vector<Maximum> maxima{{1, 2, 14.0f, 0.0f}};
    Image<float> sharpened_m, merged_m;
    sharpenMaxima(depth_m, maxima, 1.2f, 1.3f, sharpened_m);
    mergeDepths(depth_m, sharpened_m, maxima, merged_m);
    EXPECT_NEAR(merged_m(1, 2), 9.0f, 1e-6f);  // (6 + 12) / 2
    merged_m(1, 2) = 6.0f;
    EXPECT_TRUE(test::same(merged_m, depth_m));
}

}  // namespace
}  // namespace hagen
