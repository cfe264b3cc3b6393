#pragma once
#include <hagen/simulation/Scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <memory>

namespace hagen::simulation {

/// True distances from points to the nearest surface of a scene (Embree point query), of what
/// stands and of what moves.
class SceneDistance {
 public:
    /// Prepares the part of the scene that lies within `bounds_m`, widened by the reach.
    SceneDistance(const Scene& scene, const Eigen::AlignedBox3d& bounds_m, double reach_m);

    /// To the nearest surface, movers where they are at `time_s`; the reach where nothing is
    /// nearer. Single blades of grass and crop (Kind::Canopy) do not count: they bend. 0 within a
    /// rod; within what is made of triangles, the way out. May be called by several threads.
    float at(const Eigen::Vector3f& point_m, double time_s) const;
    /// As at(), of what stands alone.
    float toStanding(const Eigen::Vector3f& point_m) const;

 private:
    struct World;
    std::shared_ptr<const World> world_;
};

}  // namespace hagen::simulation
