#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/Terrain.h>

#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

double steepest(const Terrain& terrain) {
    double steepest = 0;
    for (double x = -60; x < 60; x += 1.7) {
        for (double y = -45; y < 45; y += 1.3) {
            const double dx = terrain.height_m(x + 0.5, y) - terrain.height_m(x - 0.5, y);
            const double dy = terrain.height_m(x, y + 0.5) - terrain.height_m(x, y - 0.5);
            steepest = std::max(steepest, std::hypot(dx, dy));
        }
    }
    return steepest;
}

TEST(TerrainTest, HasGivenMaxSlope) {
    for (const double slope_deg : {2.0, 15.0}) {
        TerrainParameters form;
        form.max_slope_rad = radians(slope_deg);
        form.bump_m = 0;
        Random random(5);
        EXPECT_NEAR(degrees(std::atan(steepest(Terrain(form, random)))), slope_deg,
                    0.05 * slope_deg);
    }
}

TEST(TerrainTest, PavedBandIsSmooth) {
    TerrainParameters form;
    form.max_slope_rad = 0;
    form.bump_m = 0.1;
    form.paved_half_width_m = 5;
    Random random(5);
    const Terrain terrain(form, random);
    EXPECT_EQ(terrain.height_m(3, 4.9), 0);
    EXPECT_NE(terrain.height_m(3, 5.1), 0);
    EXPECT_EQ(terrain.grassHeight_m(3, -4.9), 0);
    EXPECT_GT(terrain.grassHeight_m(3, -5.1), 0);
}

TEST(TerrainTest, GrassIsPatchyAndLimited) {
    TerrainParameters form;
    form.grass_m = 0.2;
    Random random(5);
    const Terrain terrain(form, random);
    double min = 1, max = 0;
    for (double x = -100; x < 100; x += 3) {
        min = std::min(min, terrain.grassHeight_m(x, 0.4 * x));
        max = std::max(max, terrain.grassHeight_m(x, 0.4 * x));
    }
    EXPECT_LT(min, 0.05);
    EXPECT_GT(max, 0.15);
    EXPECT_LE(max, 0.2 + 1e-6);
    EXPECT_EQ(terrain.grassHeight_m(1e6, 0), 0);
    EXPECT_EQ(terrain.grassHeight_m(NAN, 0), 0);
}

TEST(TerrainTest, MeshMatchesGround) {
    TerrainParameters form;
    form.roughness_m = 0.03;
    Random random(5);
    const Terrain terrain(form, random);
    const Shape mesh = terrain.mesh(20, 10, 60, random);
    double squares = 0;
    for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
        const Eigen::Vector3d v = vertex.cast<double>();
        squares += std::pow(v.z() - terrain.height_m(v.x(), v.y()), 2);
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(mesh.vertices_m.size())), 0.03, 0.002);
    EXPECT_GT(mesh.vertices_m.back().x(), 60);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices_m.size());
    }
    // Seen from above, triangles are counter-clockwise and cover the terrain once.
    double area_m2 = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](std::uint32_t corner) -> Eigen::Vector2d {
            return mesh.vertices_m[corner].head<2>().cast<double>();
        };
        const Eigen::Vector2d u = at(b) - at(a), v = at(c) - at(a);
        ASSERT_GT(u.x() * v.y() - u.y() * v.x(), 0);
        area_m2 += (u.x() * v.y() - u.y() * v.x()) / 2;
    }
    const Eigen::Vector3f size_m = mesh.vertices_m.back() - mesh.vertices_m.front();
    EXPECT_NEAR(area_m2, static_cast<double>(size_m.x() * size_m.y()), 0.1);
}

}  // namespace
}  // namespace hagen::simulation
