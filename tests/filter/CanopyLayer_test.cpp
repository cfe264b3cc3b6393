#include "filter/simd/CanopyLayer.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/GroundPixels.h"
#include "support/Random.h"

namespace hagen {
namespace {

using test::cellFromSensor;
using test::pixelsAt;

constexpr float kBefore_m = 0.2f;  // tolerance without a canopy

/// The tolerances relative to the plane z = 0.
Image<float> tolerated(const PixelPoints& pixels) {
    Image<float> tolerance_m = pixels.z_m.isNaN().select(
        kNoValue, Image<float>::Constant(pixels.z_m.rows(), pixels.z_m.cols(), kBefore_m));
    CellTops tops;
    PixelCells cells;
    findPixelCells(pixels, cells);
    findCellTops(cells, pixels.z_m, tops);
    tolerateCanopy(cells, tops, tolerance_m);
    return tolerance_m;
}

/// Returns at the centres of `cells` x `cells` cells around the sensor, with height(k) in cell k.
template <class Height>
std::vector<Eigen::Vector3f> field(int cells, Height height) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const auto middle_m = [&](int cell) {
                return 0.75f * (static_cast<float>(cell - cells / 2) + 0.5f);
            };
            points.emplace_back(middle_m(i), middle_m(j), height(static_cast<int>(points.size())));
        }
    }
    return points;
}

TEST(CanopyLayer, ToleratesMeanPlusTwoDeviations) {
    const auto even = field(20, [](int) { return 0.6f; });
    EXPECT_LT((tolerated(pixelsAt(even)) - 0.7f).abs().maxCoeff(), 2e-3f);
    // mean 0.6, standard deviation 0.2
    const auto mixed = field(20, [](int k) { return k % 2 == 0 ? 0.4f : 0.8f; });
    EXPECT_LT((tolerated(pixelsAt(mixed)) - 1.1f).abs().maxCoeff(), 1e-3f);
}

TEST(CanopyLayer, TwoHighReturnsFormObstacle) {
    const auto points = field(40, [](int) { return 0.6f; });
    const auto toleratedBelow = [&](std::vector<float> heights_m) {
        auto with = points;
        for (const float height_m : heights_m) with.emplace_back(1.1f, 1.1f, height_m);
        return tolerated(pixelsAt(with)).rightCols<1>().value();
    };
    // Plants up to 0.7 m are tolerated; one higher cell hardly changes their deviation.
    EXPECT_NEAR(toleratedBelow({0.79f, 0.79f}), 0.7f, 0.02f);
    EXPECT_NEAR(toleratedBelow({0.95f, 0.79f}), 0.7f, 0.03f);
    EXPECT_EQ(toleratedBelow({0.85f, 0.85f}), kBefore_m);
}

TEST(CanopyLayer, LimitsToleranceToTwiceMean) {
    // The mean of 0.288 m plus two deviations of 0.256 m exceeds the limit of twice the mean.
    const PixelPoints pixels = pixelsAt(field(20, [](int k) { return k % 5 == 0 ? 0.8f : 0.16f; }));
    const Image<float> expected_m =
        (pixels.z_m > 0.7f).select(kBefore_m, Image<float>::Constant(1, pixels.z_m.cols(), 0.676f));
    EXPECT_LT((tolerated(pixels) - expected_m).abs().maxCoeff(), 2e-3f);
}

TEST(CanopyLayer, AllowsTwentyPercentTallCells) {
    const auto share = [](int percent_tall) {
        return field(20, [=](int k) { return k % 100 < percent_tall ? 1.2f : 0.6f; });
    };
    const PixelPoints fifth = pixelsAt(share(20));
    const Image<float> expected_m =
        (fifth.z_m > 1.0f).select(kBefore_m, Image<float>::Constant(1, fifth.z_m.cols(), 0.7f));
    EXPECT_LT((tolerated(fifth) - expected_m).abs().maxCoeff(), 2e-3f);
    EXPECT_TRUE((tolerated(pixelsAt(share(21))) == kBefore_m).all());
}

TEST(CanopyLayer, NeedsThirtyFivePercentPlants) {
    const auto share = [](int percent) {
        return field(20, [=](int k) { return k % 100 < percent ? 0.6f : 0.0f; });
    };
    EXPECT_TRUE((tolerated(pixelsAt(share(34))) == kBefore_m).all());
    EXPECT_LT((tolerated(pixelsAt(share(36))) - 0.7f).abs().maxCoeff(), 2e-3f);
}

TEST(CanopyLayer, PlantHeightsAreTenToHundredCentimetres) {
    EXPECT_TRUE((tolerated(pixelsAt(field(20, [](int) { return 0.1f; }))) == kBefore_m).all());
    EXPECT_TRUE((tolerated(pixelsAt(field(20, [](int) { return 1.0f; }))) == kBefore_m).all());
    EXPECT_TRUE((tolerated(pixelsAt(field(20, [](int) { return 0.99f; }))) > 1.0f).all());
    EXPECT_TRUE((tolerated(pixelsAt(field(20, [](int) { return 0.11f; }))) > 0.2f).all());
}

TEST(CanopyLayer, NeedsThirtyCells) {
    auto points = field(6, [](int) { return 0.6f; });
    points.resize(29);
    EXPECT_TRUE((tolerated(pixelsAt(points)) == kBefore_m).all());
    points.push_back(points.back() + Eigen::Vector3f(0, 0.75f, 0));
    EXPECT_LT((tolerated(pixelsAt(points)) - 0.7f).abs().maxCoeff(), 2e-3f);
}

TEST(CanopyLayer, NeverLowersTolerance) {
    const PixelPoints pixels = pixelsAt(field(20, [](int) { return 0.3f; }));
    Image<float> tolerance_m = Image<float>::Constant(1, pixels.z_m.cols(), 5.0f);
    CellTops tops;
    PixelCells cells;
    findPixelCells(pixels, cells);
    findCellTops(cells, pixels.z_m, tops);
    tolerateCanopy(cells, tops, tolerance_m);
    EXPECT_TRUE((tolerance_m == 5.0f).all());
}

TEST(CanopyLayer, EmptyPixelsStayEmpty) {
    const PixelPoints none = pixelsAt(std::vector<Eigen::Vector3f>(40, test::kEmptyPixel), 4);
    EXPECT_TRUE(tolerated(none).isNaN().all());
}

TEST(CanopyLayer, MatchesBruteForce) {
    test::Random random(96);
    std::vector<Eigen::Vector3f> points;
    std::map<std::pair<int, int>, float> tops_m;
    std::map<std::pair<int, int>, std::vector<float>> in_cells_m;
    for (int i = 0; i < 6000; ++i) {  // plants ahead, bare ground behind, up to the border
        const float x_m = random.real(-47, 47), y_m = random.real(-47, 47);
        const bool is_plant = random.chance(x_m > 5 ? 0.5 : 0.05);
        points.emplace_back(x_m, y_m, is_plant ? random.real(0.2f, 1.2f) : 0.02f);
        float& top_m = tops_m.emplace(std::pair{cellFromSensor(x_m), cellFromSensor(y_m)}, -1.0f)
                           .first->second;
        top_m = std::max(top_m, points.back().z());
        in_cells_m[{cellFromSensor(x_m), cellFromSensor(y_m)}].push_back(points.back().z());
    }
    std::map<std::pair<int, int>, float> seconds_m;  // the second highest return, or the only one
    for (auto& [cell, heights_m] : in_cells_m) {
        std::sort(heights_m.rbegin(), heights_m.rend());
        seconds_m[cell] = heights_m[heights_m.size() > 1 ? 1 : 0];
    }
    const auto blockOf = [](int cell) { return (cell + 64) / 4; };
    std::map<std::pair<int, int>, float> canopies_m;
    for (int a = 0; a < 32; ++a) {
        for (int b = 0; b < 32; ++b) {
            double seen = 0, plants = 0, sum_m = 0, deviations_m2 = 0;
            const auto forAround = [&](auto visit) {
                for (const auto& [cell, top_m] : tops_m) {
                    const bool is_near = std::abs(blockOf(cell.first) - a) <= 6 &&
                                         std::abs(blockOf(cell.second) - b) <= 6;
                    if (is_near) visit(static_cast<double>(top_m));
                }
            };
            forAround([&](double top_m) {
                seen += 1;
                if (!(top_m > 0.1 && top_m < 1.0)) return;
                plants += 1;
                sum_m += top_m;
            });
            if (seen < 30 || plants < 0.35 * seen) continue;
            const double mean_m = sum_m / plants;
            forAround([&](double top_m) {
                if (top_m > 0.1 && top_m < 1.0) deviations_m2 += std::pow(top_m - mean_m, 2);
            });
            canopies_m[{a, b}] = static_cast<float>(
                mean_m + std::min(2 * std::sqrt(deviations_m2 / plants), mean_m) + 0.1);
        }
    }
    ASSERT_GT(canopies_m.size(), 100u);
    ASSERT_LT(canopies_m.size(), 800u);
    const Image<float> tolerance_m = tolerated(pixelsAt(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto canopy = canopies_m.find(
            {blockOf(cellFromSensor(points[i].x())), blockOf(cellFromSensor(points[i].y()))});
        const float stands_m =
            seconds_m.at({cellFromSensor(points[i].x()), cellFromSensor(points[i].y())});
        const bool has_canopy = canopy != canopies_m.end() && stands_m <= canopy->second + 0.1f;
        const float expected_m = has_canopy ? canopy->second : kBefore_m;
        ASSERT_NEAR(tolerance_m.data()[i], expected_m, 1e-3f);
    }
}

}  // namespace
}  // namespace hagen
