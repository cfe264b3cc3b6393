#pragma once
#include <hagen/simulation/Scene.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace hagen::replays {

/// What truly stood and moved on a course, to be looked at: triangles alone.
struct TrueScene {
    static constexpr double kMoverStep_s = 0.2;

    struct Mover {
        std::size_t shape;
        std::vector<Eigen::Affine3f> poses;  ///< every kMoverStep_s from the start of the flight on
    };
    /// Heights at the corners of a grid, those of one y after the other.
    struct Ground {
        Eigen::Vector2d least_m{0, 0};
        double step_m = 2;
        int along_x = 0, along_y = 0;
        std::vector<double> heights_m;
    };

    std::vector<simulation::Shape> shapes;         ///< without rods, which are tubes here
    std::vector<simulation::SceneObject> objects;  ///< but for the ground
    std::vector<Mover> movers;
    Ground ground;
};

/// The scene within which one may fly, and 20 m around it, until the flight ends.
TrueScene trueSceneOf(const simulation::Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                      double duration_s);

/// Where a mover is at a time; at the ends of what is known of it before and after.
Eigen::Affine3f poseAt(const TrueScene::Mover& mover, double time_s);

}  // namespace hagen::replays
