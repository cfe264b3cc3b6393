#pragma once
#include <hagen/simulation/ObjectClass.h>
#include <hagen/simulation/Path.h>
#include <hagen/simulation/Shape.h>
#include <hagen/simulation/Terrain.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace hagen::simulation {

/// A static object placed in a scene.
struct SceneObject {
    ObjectClass kind;
    std::uint16_t number;  ///< object number from 1; 0: part of the ground
    std::size_t shape;     ///< index in SceneContent::shapes
    Eigen::Affine3f pose;  ///< from the shape's own frame to the map
};

/// An object that moves on a circle, on the ground or in the air.
struct MovingObstacle {
    std::uint16_t number = 0;
    std::size_t shape = 0;
    Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
    double radius_m = 1, speed_m_s = 1, phase_rad = 0;
    double above_ground_m = 0;
};

/// Returns a moving obstacle's horizontal position at this time.
Eigen::Vector2d placeOf(const MovingObstacle& mover, double time_s);
/// Returns the transform from a moving obstacle's own frame to the map at this time.
Eigen::Affine3f poseOf(const MovingObstacle& mover, const Terrain& terrain, double time_s);

struct SceneContent {
    Terrain terrain;
    Path path;  ///< closed path free of obstacles
    std::vector<Shape> shapes;
    std::vector<SceneObject> objects;
    std::vector<MovingObstacle> movers;
};

/// A ray in the map. `time`: 0 at the start of the snapshot, 1 at its end.
struct Ray {
    Eigen::Vector3f origin_m;
    Eigen::Vector3f direction;  ///< unit vector
    float time = 0;
    float reach_m = std::numeric_limits<float>::infinity();  ///< maximum range
};

struct RayHit {
    float range_m;  ///< NaN: no hit
    ObjectClass kind = ObjectClass::None;
    std::uint16_t number = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit vector towards the ray's origin
};

/// A scene for ray casting with Embree. Copies share their content; const functions are
/// thread-safe.
class Scene {
 public:
    explicit Scene(SceneContent content);

    const SceneContent& content() const;
    const Terrain& terrain() const { return content().terrain; }
    const Path& path() const { return content().path; }
    /// The scene during a short time interval, with linear motion of moving obstacles.
    class Snapshot;
    Snapshot snapshotOver(double start_s, double duration_s) const;

 private:
    struct World;
    std::shared_ptr<const World> world_;
};

class Scene::Snapshot {
 public:
    /// Finds the first hit of each ray within `max_range_m`. Fastest if adjacent rays are similar.
    void cast(const std::vector<Ray>& rays, float max_range_m, std::vector<RayHit>& hits) const;

 private:
    friend class Scene;
    struct Movers;
    std::shared_ptr<const World> world_;
    std::shared_ptr<const Movers> movers_;  ///< null if there are no moving obstacles
};

}  // namespace hagen::simulation
