#include "avoidance/replays/TrueScene.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {
namespace {

/// Draws thin rods thicker: a wire of 24 mm would be narrower than a pixel.
constexpr float kMinDrawn_m = 0.03f;

simulation::Shape drawn(const simulation::Shape& shape) {
    constexpr int kSides = 6;
    simulation::Shape triangles;
    triangles.vertices_m = shape.vertices_m;
    triangles.triangles = shape.triangles;
    for (const std::uint32_t knot : shape.segments) {
        Eigen::Vector4f from = shape.polyline_m[knot], to = shape.polyline_m[knot + 1];
        from.w() = std::max(from.w(), kMinDrawn_m);
        to.w() = std::max(to.w(), kMinDrawn_m);
        triangles.addTube({from, to}, kSides);
    }
    return triangles;
}

TrueScene::Ground groundOf(const simulation::Terrain& terrain,
                           const Eigen::AlignedBox3d& bounds_m) {
    constexpr double kAround_m = 20;
    TrueScene::Ground ground;
    ground.min_m = bounds_m.min().head<2>().array() - kAround_m;
    const Eigen::Vector2d size_m = bounds_m.sizes().head<2>().array() + 2 * kAround_m;
    ground.along_x = 1 + static_cast<int>(std::ceil(size_m.x() / ground.step_m));
    ground.along_y = 1 + static_cast<int>(std::ceil(size_m.y() / ground.step_m));
    for (int j = 0; j < ground.along_y; ++j) {
        for (int i = 0; i < ground.along_x; ++i) {
            ground.heights_m.push_back(terrain.height_m(ground.min_m.x() + i * ground.step_m,
                                                        ground.min_m.y() + j * ground.step_m));
        }
    }
    return ground;
}

}  // namespace

TrueScene trueSceneOf(const simulation::Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                      double duration_s) {
    const simulation::SceneContent& content = scene.content();
    TrueScene seen;
    std::vector<bool> is_shown(content.shapes.size());
    for (const simulation::SceneObject& object : content.objects) {
        if (object.kind == simulation::ObjectClass::Terrain) continue;
        seen.objects.push_back(object);
        is_shown[object.shape] = true;
    }
    for (const simulation::MovingObstacle& mover : content.movers) {
        TrueScene::Mover& moving = seen.movers.emplace_back();
        moving.shape = mover.shape;
        is_shown[mover.shape] = true;
        const int steps = static_cast<int>(std::ceil(duration_s / TrueScene::kMoverStep_s));
        for (int step = 0; step <= steps; ++step) {
            moving.poses.push_back(
                simulation::poseOf(mover, content.terrain, step * TrueScene::kMoverStep_s));
        }
    }
    for (std::size_t i = 0; i < content.shapes.size(); ++i) {
        seen.shapes.push_back(is_shown[i] ? drawn(content.shapes[i]) : simulation::Shape{});
    }
    seen.ground = groundOf(content.terrain, bounds_m);
    return seen;
}

Eigen::Affine3f poseAt(const TrueScene::Mover& mover, double time_s) {
    const double last = static_cast<double>(mover.poses.size() - 1);
    const double rank = std::clamp(time_s / TrueScene::kMoverStep_s, 0.0, last);
    const auto before = static_cast<std::size_t>(rank);
    const auto after = std::min(before + 1, mover.poses.size() - 1);
    const auto share = static_cast<float>(rank - std::floor(rank));
    const Eigen::Affine3f &a = mover.poses[before], &b = mover.poses[after];
    const Eigen::Quaternionf turn(a.rotation()), turned(b.rotation());
    Eigen::Affine3f pose(turn.slerp(share, turned));
    pose.translation() = (1 - share) * a.translation() + share * b.translation();
    return pose;
}

}  // namespace hagen::avoidance
