#include <gtest/gtest.h>
#include <hagen/filter/PersistentMaxima.h>

#include <algorithm>
#include <string>
#include <utility>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

std::vector<Maximum> maximaOf(const Image<float>& proximity_m, float min_persistence_m = 0.0f) {
    static MaximaWorkspace work;  // reused, as in a filter
    std::vector<Maximum> maxima;
    findPersistentMaxima(proximity_m, min_persistence_m, maxima, work);
    return maxima;
}

/// The definition as a sweep: each pixel, oldest first, joins the components it touches.
std::vector<Maximum> sweptMaxima(const Image<float>& proximity_m, float min_persistence_m) {
    const int rows = static_cast<int>(proximity_m.rows());
    const int columns = static_cast<int>(proximity_m.cols());
    const auto level = [&](int p) { return proximity_m.data()[p]; };
    const auto isOlder = [&](int a, int b) {
        return level(a) > level(b) || (level(a) == level(b) && a < b);
    };
    std::vector<int> oldest_first, parent(rows * columns, -1);
    for (int pixel = 0; pixel < rows * columns; ++pixel) {
        if (level(pixel) > 0.0f) oldest_first.push_back(pixel);
    }
    std::sort(oldest_first.begin(), oldest_first.end(), isOlder);
    const auto root = [&](int pixel) {
        while (parent[pixel] != pixel) pixel = parent[pixel] = parent[parent[pixel]];
        return pixel;
    };
    std::vector<float> death_m(rows * columns, 0.0f);
    for (const int pixel : oldest_first) {
        parent[pixel] = pixel;
        for (int column_step = -1; column_step <= 1; ++column_step) {
            const int column = wrapColumn(pixel / rows + column_step, columns);
            for (int row_step = -1; row_step <= 1; ++row_step) {
                const int row = pixel % rows + row_step;
                if (row < 0 || row >= rows || parent[column * rows + row] < 0) continue;
                int elder = root(column * rows + row), younger = root(pixel);
                if (elder == younger) continue;
                if (isOlder(younger, elder)) std::swap(elder, younger);
                death_m[younger] = level(pixel);
                parent[younger] = elder;
            }
        }
    }
    std::vector<Maximum> maxima;
    for (const int pixel : oldest_first) {
        const Maximum maximum{pixel % rows, pixel / rows, level(pixel), death_m[pixel]};
        if (maximum.persistence_m() > 0.0f && maximum.persistence_m() >= min_persistence_m) {
            maxima.push_back(maximum);
        }
    }
    return maxima;
}

/// Expects bitwise equal maxima in the same order.
void expectIdentical(const std::vector<Maximum>& found, const std::vector<Maximum>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].row, expected[i].row) << i;
        ASSERT_EQ(found[i].column, expected[i].column) << i;
        ASSERT_EQ(found[i].birth_m, expected[i].birth_m) << i;
        ASSERT_EQ(found[i].death_m, expected[i].death_m) << i;
    }
}

TEST(PersistentMaxima, MatchPlainSweepOnEveryInstructionSet) {
    test::Random random(21);
    for (int round = 0; round < 150; ++round) {
        const int rows = random.chance(0.5) ? random.whole(1, 12) : random.whole(13, 128);
        const int columns = random.chance(0.5) ? random.whole(1, 5) : random.whole(6, 90);
        Image<float> proximity_m =
            random.image(rows, columns, -4.0f, 20.0f, random.chance(0.5) ? 0.02 : 0.6);
        if (random.chance(0.4)) proximity_m = proximity_m.round();  // ties, plateaus
        if (random.chance(0.3)) {                                   // long ascents
            for (int column = 0; column < columns; ++column) {
                proximity_m.col(column) += static_cast<float>(20 * column);
            }
        }
        const float min = random.chance(0.5) ? 0.0f : 1.0f;
        const auto expected = sweptMaxima(proximity_m, min);
        forEachInstructionSet([&](const std::string& name) {
            SCOPED_TRACE(name + " " + std::to_string(rows) + " x " + std::to_string(columns));
            expectIdentical(maximaOf(proximity_m, min), expected);
        });
        if (HasFatalFailure()) return;
    }
}

TEST(PersistentMaxima, LowerPeakDiesAtSaddle) {
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

TEST(PersistentMaxima, KeepsPersistenceAtThreshold) {
    Image<float> proximity_m(1, 5);
    proximity_m << 5, 2, 2.5, 0, 0;
    EXPECT_EQ(maximaOf(proximity_m, 0.5f).size(), 2u);
    EXPECT_EQ(maximaOf(proximity_m, 0.51f).size(), 1u);
}

TEST(PersistentMaxima, PlateauHasMaximumAtFirstPixel) {
    const auto maxima = maximaOf(Image<float>::Constant(4, 9, 3.0f));
    ASSERT_EQ(maxima.size(), 1u);
    EXPECT_EQ(maxima[0].row, 0);
    EXPECT_EQ(maxima[0].column, 0);
}

TEST(PersistentMaxima, WrapInAzimuthOnly) {
    Image<float> proximity_m = Image<float>::Constant(5, 9, kNoValue);
    proximity_m(2, 0) = 3.0f;
    proximity_m(2, 8) = 2.0f;  // adjacent across the seam, so not a maximum
    EXPECT_EQ(maximaOf(proximity_m).size(), 1u);
    proximity_m(2, 8) = kNoValue;
    proximity_m(0, 4) = 3.0f;
    proximity_m(4, 4) = 2.0f;  // the first and last rows are not adjacent
    EXPECT_EQ(maximaOf(proximity_m).size(), 3u);
}

TEST(PersistentMaxima, EmptyZoneHasNoMaxima) {
    EXPECT_TRUE(maximaOf(Image<float>::Constant(4, 9, 0.0f)).empty());
    EXPECT_TRUE(maximaOf(Image<float>::Constant(4, 9, kNoValue)).empty());
}

TEST(Proximity, ClosestIsHighest) {
    Image<float> depth_m(1, 5), proximity_m, expected(1, 5);
    depth_m << 0.5f, 19.0f, 20.0f, 90.0f, kNoValue;
    expected << 19.5f, 1.0f, 0.0f, 0.0f, kNoValue;
    proximityOf(depth_m, 20.0f, proximity_m);
    EXPECT_TRUE(test::same(proximity_m, expected));
}

}  // namespace
}  // namespace hagen
