#pragma once
#include <hagen/simulation/Scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <memory>

namespace hagen::simulation {

/// Exact distances from points to the nearest surface of a scene (Embree point queries).
class SceneDistance {
 public:
    /// Prepares the scene within `bounds_m`, extended by `reach_m`, the maximum distance.
    SceneDistance(const Scene& scene, const Eigen::AlignedBox3d& bounds_m, double reach_m);

    /// Returns the distance to the nearest surface at `time_s`, limited to the maximum distance. 0
    /// inside a rod; inside an object made of triangles, the distance to its surface. Ignores grass
    /// and crop (ObjectClass::Canopy), which bend. Thread-safe.
    float at(const Eigen::Vector3f& point_m, double time_s) const;
    /// Like at(), but only for static objects.
    float toStatic(const Eigen::Vector3f& point_m) const;

 private:
    struct World;
    std::shared_ptr<const World> world_;
};

}  // namespace hagen::simulation
