#pragma once
#include <hagen/simulation/Kind.h>
#include <hagen/simulation/Path.h>
#include <hagen/simulation/Shape.h>
#include <hagen/simulation/Terrain.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace hagen::simulation {

/// A thing that stands in a scene.
struct SceneObject {
    Kind kind;
    std::uint16_t number;  ///< of the object, from 1; 0: part of the ground
    std::size_t shape;     ///< index in SceneContent::shapes
    Eigen::Affine3f pose;  ///< from the shape's frame to the map
};

/// A thing that goes round on a circle, over the ground or in the air.
struct SceneMover {
    std::uint16_t number = 0;
    std::size_t shape = 0;
    Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
    double radius_m = 1, speed_m_s = 1, phase_rad = 0;
    double above_ground_m = 0;
};

/// Where a mover is at a time, seen from above.
Eigen::Vector2d placeOf(const SceneMover& mover, double time_s);
/// From a mover's own frame, where it is at a time, to the map.
Eigen::Affine3f poseOf(const SceneMover& mover, const Terrain& terrain, double time_s);

/// All that a scene is made of.
struct SceneContent {
    Terrain terrain;
    Path path;  ///< where one can fly
    std::vector<Shape> shapes;
    std::vector<SceneObject> objects;
    std::vector<SceneMover> movers;
};

/// A ray in the map. `time` within the snapshot that it is cast into: 0 its start, 1 its end.
struct Ray {
    Eigen::Vector3f origin_m;
    Eigen::Vector3f direction;  ///< of length 1
    float time = 0;
    float reach_m = std::numeric_limits<float>::infinity();  ///< what is farther is not looked for
};

struct RayHit {
    float range_m;  ///< NaN: nothing was hit
    Kind kind = Kind::None;
    std::uint16_t number = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of length 1, towards the ray's origin
};

/// A scene in which rays can be cast, by Embree. Copies share what they are made of; const
/// functions may be called by several threads at a time.
class Scene {
 public:
    explicit Scene(SceneContent content);

    const SceneContent& content() const;
    const Terrain& terrain() const { return content().terrain; }
    const Path& path() const { return content().path; }
    /// Triangles of all shapes; those that stand at several places count once.
    std::size_t triangles() const;

    /// Everything during a short time: movers go straight from where they are at its start to
    /// where they are at its end.
    class Snapshot;
    Snapshot during(double start_s, double duration_s) const;

 private:
    struct World;
    std::shared_ptr<const World> world_;
};

class Scene::Snapshot {
 public:
    /// What each ray meets first within `max_range_m`. Rays that lie side by side and come one
    /// after the other are cast fastest.
    void cast(const std::vector<Ray>& rays, float max_range_m, std::vector<RayHit>& hits) const;

 private:
    friend class Scene;
    struct Movers;
    std::shared_ptr<const World> world_;
    std::shared_ptr<const Movers> movers_;  ///< none: nothing moves
};

}  // namespace hagen::simulation
