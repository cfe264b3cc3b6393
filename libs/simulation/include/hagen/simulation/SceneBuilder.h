#pragma once
#include <hagen/simulation/Scene.h>
#include <functional>

namespace hagen::simulation {

/// How far the ground reaches, about the origin of the map: finely meshed out to both, then ever
/// more coarsely.
struct GroundExtent {
    double half_length_m = 55, half_width_m = 38, reach_m = 140;
};

/// Puts a scene together: shapes, and where they stand on the ground. What isFree() allows stays
/// kClearance_m off the path.
///
/// Never draw two random numbers in the arguments of one call: compilers differ in their order.
class SceneBuilder {
 public:
    static constexpr double kClearance_m = 0.8;
    static constexpr double kHalfLength_m = 75, kHalfWidth_m = 55;  ///< where things are scattered

    SceneBuilder(const TerrainForm& terrain, const Path& path, std::uint64_t seed);
    /// A scene without a path to keep clear: its path means nothing.
    SceneBuilder(const TerrainForm& terrain, const GroundExtent& extent, const Random& random);

    Random& random() { return random_; }
    const Terrain& terrain() const { return content_.terrain; }
    const Path& path() const { return content_.path; }

    std::size_t addShape(Shape shape);
    /// Several shapes of one sort, to be placed at random.
    std::vector<std::size_t> addShapes(int count, const std::function<Shape(Random&)>& make);
    std::size_t oneOf(const std::vector<std::size_t>& shapes);

    /// Whether a thing of this radius may stand there.
    bool isFree(double x_m, double y_m, double radius_m) const;

    /// Puts a shape on the ground there; it is turned by a yaw and scaled. Returns its number.
    std::uint16_t place(Kind kind, std::size_t shape, double x_m, double y_m, double yaw_rad,
                        const Eigen::Vector3d& scale = {1, 1, 1});
    /// Puts one of these shapes there, turned any way.
    std::uint16_t placeAnyOf(Kind kind, const std::vector<std::size_t>& shapes, double x_m,
                             double y_m, const Eigen::Vector3d& scale = {1, 1, 1});
    /// As place(), sheared so that it follows the ground's slope.
    std::uint16_t lay(Kind kind, std::size_t shape, double x_m, double y_m, double yaw_rad,
                      const Eigen::Vector3d& scale);
    /// Adds a shape that is in the map's frame already.
    std::uint16_t add(Kind kind, Shape shape);
    /// A mover; true where its circle keeps off the path.
    bool addMover(SceneMover mover, double own_radius_m);
    void addMoverAnywhere(SceneMover mover);

    /// Calls put(x, y) at random places of a density (things per square metre) over the whole
    /// scene.
    void scatter(double per_m2, const std::function<void(double x_m, double y_m)>& put);

    Scene build() { return Scene(std::move(content_)); }

 private:
    SceneBuilder(const TerrainForm& terrain, const Path& path, const GroundExtent& extent,
                 const Random& random);
    std::uint16_t nextNumber(Kind kind);

    Random random_;
    SceneContent content_;
    std::uint16_t numbers_ = 0;
};

}  // namespace hagen::simulation
