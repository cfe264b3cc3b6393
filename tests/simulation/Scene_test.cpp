#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/Scene.h>

#include <cmath>

#include "simulation/SimpleContent.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector3f;
using test::castOne;
using test::emptyContent;
using test::plane;
using test::put;
using test::sceneOf;

TEST(SceneTest, RayHitsPlane) {
    const Scene scene = sceneOf(ObjectClass::Terrain, 0, plane());
    for (const double down_deg : {1.5, 5.0, 15.0, 60.0, 90.0}) {
        const double down = radians(down_deg);
        const RayHit hit = castOne(
            scene, {0, 0, 2},
            Vector3f(static_cast<float>(std::cos(down)), 0, static_cast<float>(-std::sin(down))));
        EXPECT_NEAR(hit.range_m, 2 / std::sin(down), 1e-3) << down_deg;
        EXPECT_EQ(hit.kind, ObjectClass::Terrain);
        EXPECT_NEAR(hit.normal.z(), 1, 1e-5);
    }
}

TEST(SceneTest, RayMissesSkyAndDistance) {
    const Scene scene = sceneOf(ObjectClass::Terrain, 0, plane());
    EXPECT_TRUE(std::isnan(castOne(scene, {0, 0, 2}, {1, 0, 0.1f}).range_m));
    std::vector<RayHit> hits;
    scene.snapshotOver(0, 1).cast({{{0, 0, 2}, {0, 0, -1}}}, 1.5f, hits);
    EXPECT_EQ(hits.at(0).kind, ObjectClass::None);
    EXPECT_TRUE(std::isnan(hits[0].range_m));
    scene.snapshotOver(0, 1).cast({}, 100, hits);
    EXPECT_TRUE(hits.empty());
}

TEST(SceneTest, RayHitsRoundRod) {
    constexpr float kRadius_m = 0.2f;
    Shape rod;
    rod.addRod({{10, 0, -1, kRadius_m}, {10, 0, 5, kRadius_m}});
    const Scene scene = sceneOf(ObjectClass::Pole, 7, std::move(rod));
    for (const float aside_m : {-0.19f, -0.1f, 0.0f, 0.15f}) {
        const RayHit hit = castOne(scene, {0, aside_m, 1}, {1, 0, 0});
        EXPECT_NEAR(hit.range_m, 10 - std::sqrt(kRadius_m * kRadius_m - aside_m * aside_m), 1e-3);
        EXPECT_EQ(hit.kind, ObjectClass::Pole);
        EXPECT_EQ(hit.number, 7);
        EXPECT_NEAR(hit.normal.y(), aside_m / kRadius_m, 1e-2);
    }
    EXPECT_EQ(castOne(scene, {0, 0.21f, 1}, {1, 0, 0}).kind, ObjectClass::None);
}

TEST(SceneTest, RodEndsAreBalls) {
    Shape rod;
    rod.addRod({{10, 0, 1, 0.5f}, {10, 0, 0, 0.5f}});
    const Scene scene = sceneOf(ObjectClass::Pole, 1, std::move(rod));
    const float up_m = 0.3f;  // above the last knot
    EXPECT_NEAR(castOne(scene, {0, 0, 1 + up_m}, {1, 0, 0}).range_m,
                10 - std::sqrt(0.25f - up_m * up_m), 1e-3);
}

TEST(SceneTest, TubeApproximatesRod) {
    Shape tube;
    tube.addTube({{10, 0, -1, 0.2f}, {10, 0, 5, 0.2f}}, 16);
    const Scene scene = sceneOf(ObjectClass::Tree, 1, std::move(tube));
    EXPECT_NEAR(castOne(scene, {0, 0, 1}, {1, 0, 0}).range_m, 9.8, 0.005);
}

TEST(SceneTest, NearerObjectsOcclude) {
    SceneContent content = emptyContent();
    Shape box;
    box.addBox({5, -1, 0}, {6, 1, 3});
    put(content, ObjectClass::Wall, 3, box);
    put(content, ObjectClass::Building, 4, box, Eigen::Affine3f(Eigen::Translation3f(5, 0, 0)));
    const Scene scene(std::move(content));
    EXPECT_EQ(castOne(scene, {0, 0, 1}, {1, 0, 0}).number, 3);
    const RayHit from_behind = castOne(scene, {20, 0, 1}, {-1, 0, 0});
    EXPECT_EQ(from_behind.number, 4);
    EXPECT_NEAR(from_behind.range_m, 9, 1e-4);
    EXPECT_NEAR(from_behind.normal.x(), 1, 1e-5);  // towards the ray's origin
}

TEST(SceneTest, TransformsShapesAndNormals) {
    Shape slope;  // slope 1:1 along x
    slope.addQuad({0, -1, 0}, {1, -1, 1}, {1, 1, 1}, {0, 1, 0});
    const Eigen::Affine3f pose = Eigen::Translation3f(10, 0, 0) * Eigen::Scaling(4.0f, 4.0f, 2.0f);
    const Scene scene = sceneOf(ObjectClass::Wall, 1, slope, pose);  // scaled to 1:2
    const RayHit hit = castOne(scene, {0, 0, 1}, {1, 0, 0});
    EXPECT_NEAR(hit.range_m, 12, 1e-4);
    EXPECT_NEAR(hit.normal.x(), -1 / std::sqrt(5.0f), 1e-5);
    EXPECT_NEAR(hit.normal.z(), 2 / std::sqrt(5.0f), 1e-5);
}

TEST(SceneTest, MoversMoveWithTime) {
    SceneContent content = emptyContent();
    Shape box;
    box.addBox({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 2});
    content.shapes.push_back(box);
    MovingObstacle mover;  // the circle is so large that it moves nearly straight along +y
    mover.number = 9;
    mover.radius_m = 1000;
    mover.middle_m = {-990, 0};
    mover.speed_m_s = 10;
    content.movers.push_back(mover);
    const Scene scene(std::move(content));
    EXPECT_EQ(castOne(scene, {0, 0, 1}, {1, 0, 0}, 0).number, 9);
    EXPECT_NEAR(castOne(scene, {0, 0, 1}, {1, 0, 0}, 0).range_m, 9.5, 0.01);
    // After 0.1 s, the mover has moved by 1 m.
    EXPECT_EQ(castOne(scene, {0, 0, 1}, {1, 0, 0}, 1.0f).kind, ObjectClass::None);
    EXPECT_EQ(castOne(scene, {0, 1, 1}, {1, 0, 0}, 1.0f).kind, ObjectClass::Mover);
    std::vector<RayHit> hits;
    scene.snapshotOver(2.0, 0.1).cast({{{0, 20, 1}, {1, 0, 0}, 0}}, 200, hits);
    EXPECT_EQ(hits.at(0).number, 9);
}

TEST(SceneTest, SnapshotsOutliveScene) {
    const auto snapshot = sceneOf(ObjectClass::Terrain, 0, plane()).snapshotOver(0, 1);
    std::vector<RayHit> hits;
    snapshot.cast({{{0, 0, 3}, {0, 0, -1}}}, 100, hits);
    EXPECT_NEAR(hits.at(0).range_m, 3, 1e-5);
}

}  // namespace
}  // namespace hagen::simulation
