#pragma once
#include <hagen/simulation/Scene.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace hagen::avoidance {

/// The true static and moving obstacles of a course, as triangles for visualization.
struct TrueScene {
    static constexpr double kMoverStep_s = 0.2;

    struct Mover {
        std::size_t shape;
        std::vector<Eigen::Affine3f> poses;  ///< every kMoverStep_s from the start of the flight
    };
    /// Heights at the corners of a grid, row by row (x varies fastest).
    struct Ground {
        Eigen::Vector2d min_m{0, 0};
        double step_m = 2;
        int along_x = 0, along_y = 0;
        std::vector<double> heights_m;
    };

    std::vector<simulation::Shape> shapes;         ///< rods are converted to tubes
    std::vector<simulation::SceneObject> objects;  ///< without the ground
    std::vector<Mover> movers;
    Ground ground;
};

/// The scene within 20 m around the bounds of the flight, until it ends.
TrueScene trueSceneOf(const simulation::Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                      double duration_s);

/// The pose of a mover at a time, clamped to its first and last pose.
Eigen::Affine3f poseAt(const TrueScene::Mover& mover, double time_s);

}  // namespace hagen::avoidance
