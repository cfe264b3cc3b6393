#pragma once
#include <hagen/simulation/Scene.h>
#include <functional>

namespace hagen::simulation {

/// Extent of the ground: fine mesh up to the half sizes, then coarser out to `reach_m`.
struct GroundExtent {
    double half_length_m = 55, half_width_m = 38, reach_m = 140;
};

/// Builds a scene from shapes placed on the ground. isFree() keeps kClearance_m from the path.
///
/// Never draw two random numbers in the arguments of one call: the order of evaluation differs
/// between compilers.
class SceneBuilder {
 public:
    static constexpr double kClearance_m = 0.8;
    static constexpr double kHalfLength_m = 75, kHalfWidth_m = 55;  ///< of scatter()

    SceneBuilder(const TerrainParameters& form, const Path& path, std::uint64_t seed);
    /// Starts a scene without a path.
    SceneBuilder(const TerrainParameters& form, const GroundExtent& extent, const Random& random);

    Random& random() { return random_; }
    const Terrain& terrain() const { return content_.terrain; }
    const Path& path() const { return content_.path; }

    std::size_t addShape(Shape shape);
    /// Adds several variants of a shape.
    std::vector<std::size_t> addShapes(int count, const std::function<Shape(Random&)>& make);
    std::size_t randomOf(const std::vector<std::size_t>& shapes);

    /// True if an object of this radius may be placed there.
    bool isFree(double x_m, double y_m, double radius_m) const;

    /// Places a rotated and scaled shape on the ground. Returns its object number.
    std::uint16_t place(ObjectClass kind, std::size_t shape, double x_m, double y_m, double yaw_rad,
                        const Eigen::Vector3d& scale = {1, 1, 1});
    /// Places one of these shapes with a random yaw.
    std::uint16_t placeRandomOf(ObjectClass kind, const std::vector<std::size_t>& shapes,
                                double x_m, double y_m, const Eigen::Vector3d& scale = {1, 1, 1});
    /// Like place(), but sheared to follow the ground's slope.
    std::uint16_t placeOnSlope(ObjectClass kind, std::size_t shape, double x_m, double y_m,
                               double yaw_rad, const Eigen::Vector3d& scale);
    /// Adds a shape that is already in the map's frame.
    std::uint16_t add(ObjectClass kind, Shape shape);
    /// Adds a moving obstacle unless its circle intersects the path. True if added.
    bool addMover(MovingObstacle mover, double own_radius_m);
    void addRandomMover(MovingObstacle mover);

    /// Calls put(x, y) at random positions with the given density.
    void scatter(double per_m2, const std::function<void(double x_m, double y_m)>& put);

    Scene build() { return Scene(std::move(content_)); }

 private:
    SceneBuilder(const TerrainParameters& form, const Path& path, const GroundExtent& extent,
                 const Random& random);
    std::uint16_t nextNumber(ObjectClass kind);

    Random random_;
    SceneContent content_;
    std::uint16_t numbers_ = 0;
};

}  // namespace hagen::simulation
