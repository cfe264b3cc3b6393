#include <gtest/gtest.h>
#include <hagen/filter/GroundSurface.h>

#include <algorithm>
#include <cmath>

#include "support/GroundPixels.h"
#include "support/Random.h"

namespace hagen {
namespace {

using test::groundPoints;
using test::pixelsAt;

constexpr int kCells = GroundSurface::kCells;
constexpr float kCell_m = GroundSurface::kCell_m;
using Grid = Eigen::ArrayXXf;
GroundSurfaceWorkspace surface_work;  // reused, as in a filter

GroundSurface surfaceUnder(const std::vector<Eigen::Vector3f>& points_m) {
    GroundSurface surface;
    const PixelPoints pixels = pixelsAt(points_m);
    const Image<bool> all = Image<bool>::Constant(1, pixels.x_m.cols(), true);
    fitGroundSurface(pixels, all, surface, surface_work);
    return surface;
}

float middleOf(int cell) { return (static_cast<float>(cell) + 0.5f) * kCell_m - 48.0f; }

/// The maximum deviation of the surface from a height, within a square around the sensor.
template <class Height>
float greatestError(const GroundSurface& surface, float reach_m, Height height) {
    float greatest_m = 0;
    for (const Eigen::Vector3f& p : groundPoints(reach_m, 0.31f, height)) {
        greatest_m = std::max(greatest_m, std::abs(surface.at(p.x(), p.y()) - p.z()));
    }
    return greatest_m;
}

const auto kLevel = [](float, float) { return 0.0f; };
const auto kHill = [](float x_m, float y_m) {
    return 1.5f * std::exp(-(x_m * x_m + y_m * y_m) / (2 * 8 * 8));
};

TEST(GroundSurface, IsBilinearBetweenCellCentres) {
    GroundSurface surface;
    surface.height_m = Grid::Zero(kCells, kCells);
    surface.height_m(64, 70) = 1;
    surface.height_m(65, 70) = 2;
    surface.height_m(64, 71) = 3;
    surface.height_m(65, 71) = 5;
    const float x_m = middleOf(64), y_m = middleOf(70);
    EXPECT_FLOAT_EQ(x_m, 0.375f);
    EXPECT_NEAR(surface.at(x_m, y_m), 1, 1e-4);
    EXPECT_NEAR(surface.at(x_m + kCell_m, y_m), 2, 1e-4);
    EXPECT_NEAR(surface.at(x_m, y_m + kCell_m), 3, 1e-4);
    EXPECT_NEAR(surface.at(x_m + 0.25f * kCell_m, y_m), 1.25f, 1e-4);
    EXPECT_NEAR(surface.at(x_m, y_m + 0.25f * kCell_m), 1.5f, 1e-4);
    // 0.25 in x, 0.5 in y: 0.375 * 1 + 0.125 * 2 + 0.375 * 3 + 0.125 * 5
    EXPECT_NEAR(surface.at(x_m + 0.25f * kCell_m, y_m + 0.5f * kCell_m), 2.375f, 1e-4);
}

TEST(GroundSurface, ExtendsBorderOutwards) {
    GroundSurface surface;
    surface.height_m = Grid::Zero(kCells, kCells);
    surface.height_m(0, 0) = 1;
    surface.height_m(kCells - 1, 64) = 2;
    EXPECT_FLOAT_EQ(surface.at(-60, -70), 1);
    EXPECT_FLOAT_EQ(surface.at(100, middleOf(64)), 2);
}

TEST(GroundSurface, IsPlaneWithoutCandidates) {
    EXPECT_TRUE((surfaceUnder({test::kEmptyPixel}).height_m == 0).all());
    GroundSurface surface;
    const PixelPoints high = pixelsAt({{5, 0, 3}});
    fitGroundSurface(high, Image<bool>::Constant(1, 1, false).eval(), surface, surface_work);
    EXPECT_EQ(surface.height_m.rows(), kCells);
    EXPECT_EQ(surface.height_m.cols(), kCells);
    EXPECT_TRUE((surface.height_m == 0).all());
}

TEST(GroundSurface, SingleHeightFillsSquare) {
    test::Random random(80);
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 40; ++i) {
        points.emplace_back(random.real(-47, 47), random.real(-47, 47), 0.7f);
    }
    EXPECT_LT((surfaceUnder(points).height_m - 0.7f).abs().maxCoeff(), 1e-5f);
    EXPECT_LT((surfaceUnder({points.front()}).height_m - 0.7f).abs().maxCoeff(), 1e-5f);
}

/// Whether a cell with returns at `height_m`, `cells` away from a cell of level ground, is ground.
bool isGround(int cells, float height_m, bool diagonally, bool seen_between) {
    std::vector<Eigen::Vector3f> points{{middleOf(64), middleOf(64), 0}};
    const int y = diagonally ? 64 + cells : 64;
    points.emplace_back(middleOf(64 + cells), middleOf(y), height_m);
    for (int k = 1; seen_between && k < cells; ++k) {  // too high to be ground themselves
        points.emplace_back(middleOf(64 + k), middleOf(diagonally ? 64 + k : 64), 30.0f);
    }
    return !(surfaceUnder(points).height_m == 0).all();
}

TEST(GroundSurface, RemovesCellsAboveSteepestSlopes) {
    // The last step leads to a cell with a candidate, the others cross cells without candidates.
    const float cells = 10, step_m = 0.75f;
    const float unseen_m = (0.15f * (cells - 1) + 0.3f) * step_m + 0.15f;
    EXPECT_TRUE(isGround(10, unseen_m - 0.01f, false, false));
    EXPECT_FALSE(isGround(10, unseen_m + 0.01f, false, false));
    const float seen_m = 0.3f * cells * step_m + 0.15f;
    EXPECT_TRUE(isGround(10, unseen_m + 0.01f, false, true));
    EXPECT_FALSE(isGround(10, seen_m + 0.01f, false, true));
    const float across_m = (0.15f * (cells - 1) + 0.3f) * step_m * std::sqrt(2.0f) + 0.15f;
    EXPECT_TRUE(isGround(10, across_m - 0.01f, true, false));
    EXPECT_FALSE(isGround(10, across_m + 0.01f, true, false));
}

TEST(GroundSurface, SlopesAreIsotropic) {
    // Level ground and a plateau of 3 x 3 cells each, surrounded by walls. The far corner of the
    // plateau is 4 straight and 5 diagonal steps away.
    const float height_m = 0.3f * kCell_m * (4 + 5 * std::sqrt(2.0f)) + 0.15f;
    for (const auto& [dx, dy] :
         {std::pair{9, 5}, {9, -5}, {-9, 5}, {-9, -5}, {5, 9}, {5, -9}, {-5, 9}, {-5, -9}}) {
        const auto isPlateauGround = [&, x0 = dx, y0 = dy](float plateau_m) {
            std::vector<Eigen::Vector3f> points;
            for (int x = -12; x <= 12; ++x) {
                for (int y = -12; y <= 12; ++y) {
                    const bool is_start = std::abs(x) <= 1 && std::abs(y) <= 1;
                    const bool is_plateau = std::abs(x - x0) <= 1 && std::abs(y - y0) <= 1;
                    const float z_m = is_start ? 0.0f : is_plateau ? plateau_m : 30.0f;
                    points.emplace_back(middleOf(64 + x), middleOf(64 + y), z_m);
                }
            }
            return !(surfaceUnder(points).height_m == 0).all();
        };
        EXPECT_TRUE(isPlateauGround(height_m - 0.01f)) << dx << " " << dy;
        EXPECT_FALSE(isPlateauGround(height_m + 0.01f)) << dx << " " << dy;
    }
}

TEST(GroundSurface, FollowsGentleHill) {
    EXPECT_LT(greatestError(surfaceUnder(groundPoints(40, 0.25f, kHill)), 38, kHill), 0.05f);
}

TEST(GroundSurface, WallDoesNotLiftHiddenGround) {
    // The ground is hidden within 1 m of the wall and for 6 m behind it.
    std::vector<Eigen::Vector3f> points;
    for (const Eigen::Vector3f& p : groundPoints(25, 0.25f, kLevel)) {
        if (!(p.x() > 9 && p.x() < 16 && std::abs(p.y()) < 6)) points.push_back(p);
    }
    for (int i = -20; i <= 20; ++i) {
        for (int k = 3; k < 15; ++k) {
            points.emplace_back(10.0f, 0.25f * static_cast<float>(i),
                                0.25f * static_cast<float>(k));
        }
    }
    EXPECT_LT(greatestError(surfaceUnder(points), 20, kLevel), 0.02f);
}

TEST(GroundSurface, IgnoresPointsOutsideSquare) {
    auto points = groundPoints(10, 0.5f, kLevel);
    points.emplace_back(48.01f, 0.0f, -5.0f);
    points.emplace_back(0.0f, -48.01f, -5.0f);
    points.insert(points.end(), 50, test::kEmptyPixel);
    EXPECT_TRUE((surfaceUnder(points).height_m == 0).all());
}

TEST(GroundSurface, IgnoresOtherPixels) {
    auto points = groundPoints(10, 0.5f, kLevel);
    const std::size_t ground = points.size();
    for (std::size_t i = 0; i < ground; ++i) points.push_back(points[i] - Eigen::Vector3f(0, 0, 1));
    Image<bool> is_candidate(1, points.size());
    is_candidate.leftCols(static_cast<Eigen::Index>(ground)) = true;
    is_candidate.rightCols(static_cast<Eigen::Index>(ground)) = false;
    GroundSurface surface;
    fitGroundSurface(pixelsAt(points), is_candidate, surface, surface_work);
    EXPECT_TRUE((surface.height_m == 0).all());
}

TEST(GroundSurface, RecoversGroundCutOffByLabels) {
    // A 0.15 m mound, labelled as an obstacle, with a 2 m bush on top.
    const auto mound = [](float x_m, float y_m) {
        return 0.15f * std::exp(-((x_m - 8) * (x_m - 8) + y_m * y_m) / (2 * 2 * 2));
    };
    auto points = groundPoints(20, 0.25f, mound);
    std::vector<Label> labels;
    for (const auto& p : points) {
        labels.push_back((p - Eigen::Vector3f(8, 0, 0)).norm() < 4 ? Label::Roi : Label::Rou);
    }
    for (const auto& p : groundPoints(1, 0.1f, kLevel)) {
        points.emplace_back(p.x() + 8, p.y(), 2.0f);
        labels.push_back(Label::Roi);
    }
    const Image<Label> image =
        Eigen::Map<Image<Label>>(labels.data(), 1, static_cast<Eigen::Index>(labels.size()));
    const PixelPoints pixels = pixelsAt(points);
    GroundSurface of_rou, surface;
    fitGroundSurface(pixels, (image == Label::Rou).eval(), of_rou, surface_work);
    fitGroundSurface(pixels, image, surface, surface_work);
    EXPECT_LT(of_rou.at(8, 0), 0.1f);
    EXPECT_LT(greatestError(surface, 18, mound), 0.03f);
}

// Blocks 0.3 m high hide the ground: the slope limits accept them, but the first fit does not. The
// same applies to mirrored blocks below ground.
TEST(GroundSurface, KeepsDistantPixelsExcluded) {
    for (const float height_m : {0.3f, -0.5f}) {
        auto points = groundPoints(20, 0.25f, kLevel);
        std::vector<Label> labels;
        for (auto& p : points) {
            const bool is_block = std::abs(p.x() - 8) < 2 && std::abs(p.y()) < 2;
            if (is_block) p.z() = height_m;
            labels.push_back(is_block ? Label::Roi : Label::Rou);
        }
        GroundSurface surface;
        fitGroundSurface(
            pixelsAt(points),
            Eigen::Map<Image<Label>>(labels.data(), 1, static_cast<Eigen::Index>(labels.size())),
            surface, surface_work);
        EXPECT_LT(greatestError(surface, 18, kLevel), 0.01f);
    }
}

TEST(GroundSurface, HeightsAreAboveSurface) {
    GroundSurface surface;
    surface.height_m = Grid::Constant(kCells, kCells, 0.5f);
    Image<float> height_m;
    heightsAbove(surface, pixelsAt({{3, 4, 2}, test::kEmptyPixel, {60, 0, -1}}), height_m);
    EXPECT_FLOAT_EQ(height_m(0, 0), 1.5f);
    EXPECT_FALSE(hasValue(height_m(0, 1)));
    EXPECT_FLOAT_EQ(height_m(0, 2), -1.5f);
}

}  // namespace
}  // namespace hagen
