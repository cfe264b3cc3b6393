#include <gtest/gtest.h>
#include <hagen/segmentation/PersistentMaxima.h>

#include <algorithm>
#include <cmath>

#include "support/Random.h"

namespace hagen {
namespace {

std::vector<Maximum> maximaOf(const Image<float>& proximity_m, float min_persistence_m = 0.0f) {
    std::vector<Maximum> maxima;
    findPersistentMaxima(proximity_m, min_persistence_m, maxima);
    return maxima;
}

/// The definition, with no sweep and no union-find: a pixel dies at the highest level at which a
/// path joins it to an older pixel, that is the greatest, over all paths to any older pixel, of the
/// lowest proximity on the path. Found by widest paths between all pairs (Floyd and Warshall).
std::vector<Maximum> bruteForceMaxima(const Image<float>& proximity_m, float min_persistence_m) {
    const int rows = static_cast<int>(proximity_m.rows());
    const int columns = static_cast<int>(proximity_m.cols());
    const int pixels = rows * columns;
    const auto level = [&](int p) { return proximity_m.data()[p]; };
    const auto present = [&](int p) { return level(p) > 0.0f; };
    Eigen::ArrayXXf widest = Eigen::ArrayXXf::Zero(pixels, pixels);
    for (int a = 0; a < pixels; ++a) {
        for (int b = 0; b < pixels; ++b) {
            const int row_step = std::abs(a % rows - b % rows);
            const int column_step = std::abs(a / rows - b / rows);
            const bool beside = column_step <= 1 || column_step == columns - 1;
            if (present(a) && present(b) && row_step <= 1 && beside) {
                widest(a, b) = std::min(level(a), level(b));
            }
        }
    }
    for (int via = 0; via < pixels; ++via) {
        for (int a = 0; a < pixels; ++a) {
            for (int b = 0; b < pixels; ++b) {
                widest(a, b) = std::max(widest(a, b), std::min(widest(a, via), widest(via, b)));
            }
        }
    }
    std::vector<Maximum> maxima;
    for (int p = 0; p < pixels; ++p) {
        if (!present(p)) continue;
        float death_m = 0.0f;
        for (int q = 0; q < pixels; ++q) {
            const bool older =
                present(q) && (level(q) > level(p) || (level(q) == level(p) && q < p));
            if (older) death_m = std::max(death_m, widest(p, q));
        }
        const Maximum maximum{p % rows, p / rows, level(p), death_m};
        if (maximum.persistence_m() > 0.0f && maximum.persistence_m() >= min_persistence_m) {
            maxima.push_back(maximum);
        }
    }
    return maxima;
}

void expectSame(std::vector<Maximum> found, std::vector<Maximum> expected) {
    const auto by_pixel = [](const Maximum& a, const Maximum& b) {
        return std::pair(a.column, a.row) < std::pair(b.column, b.row);
    };
    std::sort(found.begin(), found.end(), by_pixel);
    std::sort(expected.begin(), expected.end(), by_pixel);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].row, expected[i].row);
        EXPECT_EQ(found[i].column, expected[i].column);
        EXPECT_EQ(found[i].birth_m, expected[i].birth_m);
        EXPECT_EQ(found[i].death_m, expected[i].death_m);
    }
}

TEST(PersistentMaxima, AgreeWithBruteForceOnRandomImages) {
    test::Random random(9);
    for (int round = 0; round < 60; ++round) {
        const Image<float> proximity_m =
            random.image(random.whole(1, 5), random.whole(3, 8), -2.0f, 8.0f, 0.15).max(0.0f);
        const float least = random.chance(0.5) ? 0.0f : 1.0f;
        expectSame(maximaOf(proximity_m, least), bruteForceMaxima(proximity_m, least));
    }
}

TEST(PersistentMaxima, AgreeWithBruteForceWhereManyPixelsAreEquallyHigh) {
    test::Random random(10);
    for (int round = 0; round < 60; ++round) {
        Image<float> proximity_m = random.image(4, 7, 0.0f, 4.0f, 0.2);
        proximity_m = proximity_m.round();
        expectSame(maximaOf(proximity_m), bruteForceMaxima(proximity_m, 0.0f));
    }
}

TEST(PersistentMaxima, TheLowerOfTwoPeaksDiesAtTheSaddle) {
    Image<float> proximity_m(1, 6);
    proximity_m << 5, 2, 4, 1, 0, 1;
    const auto maxima = maximaOf(proximity_m, 0.5f);
    ASSERT_EQ(maxima.size(), 2u);
    EXPECT_EQ(maxima[0].column, 0);
    EXPECT_EQ(maxima[0].birth_m, 5.0f);
    EXPECT_EQ(maxima[0].death_m, 0.0f);
    EXPECT_EQ(maxima[1].column, 2);
    EXPECT_EQ(maxima[1].birth_m, 4.0f);
    EXPECT_EQ(maxima[1].death_m, 2.0f);
    EXPECT_EQ(maxima[1].persistence_m(), 2.0f);
}

TEST(PersistentMaxima, PersistenceAtTheThresholdIsKept) {
    Image<float> proximity_m(1, 5);
    proximity_m << 5, 2, 2.5, 0, 0;
    EXPECT_EQ(maximaOf(proximity_m, 0.5f).size(), 2u);
    EXPECT_EQ(maximaOf(proximity_m, 0.51f).size(), 1u);
}

TEST(PersistentMaxima, APlateauHasOneMaximumAtItsFirstPixel) {
    const auto maxima = maximaOf(Image<float>::Constant(4, 9, 3.0f));
    ASSERT_EQ(maxima.size(), 1u);
    EXPECT_EQ(maxima[0].row, 0);
    EXPECT_EQ(maxima[0].column, 0);
}

TEST(PersistentMaxima, TheAzimuthWrapsAroundAndRowsDoNot) {
    Image<float> proximity_m = Image<float>::Constant(5, 9, kNoValue);
    proximity_m(2, 0) = 3.0f;
    proximity_m(2, 8) = 2.0f;  // beside the first, around the back: no maximum of its own
    EXPECT_EQ(maximaOf(proximity_m).size(), 1u);
    proximity_m(2, 8) = kNoValue;
    proximity_m(0, 4) = 3.0f;
    proximity_m(4, 4) = 2.0f;  // first and last row: two
    EXPECT_EQ(maximaOf(proximity_m).size(), 3u);
}

TEST(PersistentMaxima, EmptyPixelsSeparate) {
    Image<float> proximity_m(1, 7);
    proximity_m << 5, kNoValue, 4, kNoValue, 3, kNoValue, kNoValue;
    for (const Maximum& maximum : maximaOf(proximity_m)) EXPECT_EQ(maximum.death_m, 0.0f);
    EXPECT_EQ(maximaOf(proximity_m).size(), 3u);
}

TEST(PersistentMaxima, NothingInTheZoneHasNone) {
    EXPECT_TRUE(maximaOf(Image<float>::Constant(4, 9, 0.0f)).empty());
    EXPECT_TRUE(maximaOf(Image<float>::Constant(4, 9, kNoValue)).empty());
}

TEST(Proximity, ClosestIsHighestAndEmptyStaysEmpty) {
    Image<float> depth_m(1, 5), proximity_m, expected(1, 5);
    depth_m << 0.5f, 19.0f, 20.0f, 90.0f, kNoValue;
    expected << 19.5f, 1.0f, 0.0f, 0.0f, kNoValue;
    proximityOf(depth_m, 20.0f, proximity_m);
    EXPECT_TRUE(test::same(proximity_m, expected));
}

}  // namespace
}  // namespace hagen
