#include "filter/simd/CanopyLayer.h"
#include <gtest/gtest.h>

#include "support/GroundPixels.h"

namespace hagen {
namespace {

using test::pixelsAt;

constexpr float kBefore_m = 0.2f;  // tolerance without a canopy

/// The tolerances relative to the plane z = 0.
Image<float> tolerated(const PixelPoints& pixels, float sensor_height_m = 2) {
    Image<float> tolerance_m = pixels.z_m.isNaN().select(
        kNoValue, Image<float>::Constant(pixels.z_m.rows(), pixels.z_m.cols(), kBefore_m));
    CellTops tops;
    PixelCells cells;
    findPixelCells(pixels, cells);
    findCellTops(cells, pixels.z_m, tops);
    tolerateCanopy(cells, tops, sensor_height_m, tolerance_m);
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

TEST(CanopyLayer, IsAtMostThreeSensorHeights) {
    const PixelPoints plants = pixelsAt(field(20, [](int) { return 0.6f; }));
    EXPECT_LT((tolerated(plants, 0.61f / 3) - 0.7f).abs().maxCoeff(), 2e-3f);
    EXPECT_TRUE((tolerated(plants, 0.59f / 3) == kBefore_m).all());
    // A quarter of the cells contain the lower part of a trunk.
    const auto trunks = pixelsAt(field(20, [](int k) { return k % 4 == 0 ? 0.5f : 0.15f; }));
    EXPECT_GT(tolerated(trunks, 0.2f).minCoeff(), 0.3f);
    EXPECT_TRUE((tolerated(trunks, 0.13f) == kBefore_m).all());
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
    tolerateCanopy(cells, tops, 2, tolerance_m);
    EXPECT_TRUE((tolerance_m == 5.0f).all());
}

}  // namespace
}  // namespace hagen
