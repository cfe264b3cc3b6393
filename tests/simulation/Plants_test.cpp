#include "simulation/Plants.h"
#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/SimpleContent.h"

namespace hagen::simulation {
namespace {

/// Share of level rays that pass through a shape, at one height and within a half width.
double shareThatPasses(Shape shape, float z_m, float half_width_m) {
    const Scene scene = test::sceneOf(ObjectClass::Tree, 1, std::move(shape));
    std::vector<Ray> rays;
    for (float y = -half_width_m; y <= half_width_m; y += 0.02f * half_width_m) {
        for (float up = -0.1f; up <= 0.1f; up += 0.02f)
            rays.push_back({{-9, y, z_m + up}, {1, 0, 0}});
    }
    std::vector<RayHit> hits;
    scene.snapshotOver(0, 1).cast(rays, 50, hits);
    const auto passed = std::count_if(
        hits.begin(), hits.end(), [](const RayHit& hit) { return hit.kind == ObjectClass::None; });
    return static_cast<double>(passed) / static_cast<double>(rays.size());
}

TEST(PlantsTest, CrownsArePorous) {
    Random random(11);
    TreeParameters form;
    const Shape tree = makeTree(form, random);
    const double through_crown = shareThatPasses(tree, 2.2f, 0.8f);
    EXPECT_GT(through_crown, 0.08);
    EXPECT_LT(through_crown, 0.7);
    form.low_branches = 0;
    EXPECT_LT(shareThatPasses(makeTree(form, random), 0.4f, 0.04f), 0.01);
}

TEST(PlantsTest, TreesMatchParameters) {
    Random random(11);
    TreeParameters form;
    form.height_m = 6;
    const Shape tree = makeTree(form, random);
    float top = 0, widest = 0, area = 0;
    for (const Eigen::Vector3f& vertex : tree.vertices_m) {
        top = std::max(top, vertex.z());
        widest = std::max(widest, vertex.head<2>().norm());
    }
    for (const auto& t : tree.triangles) {
        const Eigen::Vector3f &a = tree.vertices_m[t[0]], &b = tree.vertices_m[t[1]];
        area += 0.5f * (b - a).cross(tree.vertices_m[t[2]] - a).norm();
    }
    EXPECT_NEAR(top, 6, 1.2);
    EXPECT_LT(widest, 1.7f * static_cast<float>(form.crown_radius_m));
    EXPECT_GT(area, form.leaf_area_m2);  // leaves plus wood
}

TEST(PlantsTest, CropShowsGround) {
    Random random(11);
    SceneContent content = test::emptyContent();
    test::put(content, ObjectClass::Terrain, 0, test::plane());
    test::put(content, ObjectClass::Canopy, 0, makeCanopyPatch(20, random),
              Eigen::Affine3f(Eigen::Scaling(1.0f, 1.0f, 0.6f)));
    std::vector<Ray> rays;  // rays point 15 degrees down, across the rows
    for (float x = -5; x < 5; x += 0.013f) {
        rays.push_back({{x, -10, 2.5f}, Eigen::Vector3f(0, 0.966f, -0.259f)});
    }
    std::vector<RayHit> hits;
    Scene(std::move(content)).snapshotOver(0, 1).cast(rays, 50, hits);
    int ground = 0, crop = 0;
    for (const RayHit& hit : hits) {
        ground += hit.kind == ObjectClass::Terrain;
        crop += hit.kind == ObjectClass::Canopy;
    }
    EXPECT_GT(ground, 0.05 * static_cast<double>(hits.size()));
    EXPECT_GT(crop, 0.4 * static_cast<double>(hits.size()));
}

TEST(PlantsTest, SmallPlantsHaveSizeAndVisibleLeaves) {
    Random random(11);
    for (const Shape& shape : {makeCanopyPatch(5, random), makeTuft(random), makeShrub(random)}) {
        float top = 0;
        for (const Eigen::Vector3f& vertex : shape.vertices_m) top = std::max(top, vertex.z());
        EXPECT_GT(top, 0.8f);
        EXPECT_LT(top, 1.3f);
        for (const auto& [a, b, c] : shape.triangles) {
            const Eigen::Vector3f &at = shape.vertices_m[a], u = shape.vertices_m[b] - at,
                                  v = shape.vertices_m[c] - at;
            EXPECT_GT(u.cross(v).norm() / 2, 5e-4f);  // 5 cm2
        }
    }
}

}  // namespace
}  // namespace hagen::simulation
