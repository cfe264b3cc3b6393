#pragma once
#include <hagen/simulation/Scene.h>

namespace hagen::test {

/// Content with level, smooth ground and no grass or objects.
inline simulation::SceneContent emptyContent() {
    simulation::TerrainParameters level;
    level.max_slope_rad = level.bump_m = level.roughness_m = level.grass_m = 0;
    simulation::Random random(1);
    return {simulation::Terrain(level, random), simulation::Path{30, 10}, {}, {}, {}};
}

inline void put(simulation::SceneContent& content, simulation::ObjectClass kind,
                std::uint16_t number, simulation::Shape shape,
                const Eigen::Affine3f& pose = Eigen::Affine3f::Identity()) {
    content.shapes.push_back(std::move(shape));
    content.objects.push_back({kind, number, content.shapes.size() - 1, pose});
}

/// A scene with one object.
inline simulation::Scene sceneOf(simulation::ObjectClass kind, std::uint16_t number,
                                 simulation::Shape shape,
                                 const Eigen::Affine3f& pose = Eigen::Affine3f::Identity()) {
    simulation::SceneContent content = emptyContent();
    put(content, kind, number, std::move(shape), pose);
    return simulation::Scene(std::move(content));
}

/// A square of level ground at z = 0.
inline simulation::Shape plane(float half_m = 100) {
    simulation::Shape shape;
    shape.addQuad({-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0},
                  {-half_m, half_m, 0});
    return shape;
}

inline simulation::RayHit castOne(const simulation::Scene& scene, const Eigen::Vector3f& from,
                                  const Eigen::Vector3f& direction, float time = 0) {
    std::vector<simulation::RayHit> hits;
    scene.snapshotOver(0, 0.1).cast({{from, direction.normalized(), time}}, 200.0f, hits);
    return hits.front();
}

}  // namespace hagen::test
