#pragma once
#include <hagen/simulation/Scene.h>
#include <functional>

namespace hagen::simulation {

/// Extent of the ground: fine mesh up to the half sizes, coarser mesh up to `reach_m`.
struct GroundExtent {
    double half_length_m = 55, half_width_m = 38, reach_m = 140;
};

/// Builds a scene from shapes placed on the ground.
/// Never draw two random numbers in the arguments of one call, because the evaluation order differs
/// between compilers.
class SceneBuilder {
 public:
    static constexpr double kClearance_m = 0.8;
    static constexpr double kHalfLength_m = 75, kHalfWidth_m = 55;  ///< area of scatter()

    SceneBuilder(const TerrainParameters& form, const Path& path, std::uint64_t seed);
    SceneBuilder(const TerrainParameters& form, const GroundExtent& extent, const Random& random);

    Random& random() { return random_; }
    const Terrain& terrain() const { return content_.terrain; }
    const Path& path() const { return content_.path; }

    std::size_t addShape(Shape shape);
    /// Adds random variants of a shape. Returns their indices.
    std::vector<std::size_t> addShapes(int count, const std::function<Shape(Random&)>& make);
    std::size_t randomOf(const std::vector<std::size_t>& shapes);

    /// True if an object of this radius is at least kClearance_m away from the path.
    bool isFree(double x_m, double y_m, double radius_m) const;

    /// Places a rotated and scaled shape on the ground. Returns the object number.
    std::uint16_t place(ObjectClass kind, std::size_t shape, double x_m, double y_m, double yaw_rad,
                        const Eigen::Vector3d& scale = {1, 1, 1});
    /// Places a randomly chosen shape with a random yaw.
    std::uint16_t placeRandomOf(ObjectClass kind, const std::vector<std::size_t>& shapes,
                                double x_m, double y_m, const Eigen::Vector3d& scale = {1, 1, 1});
    /// Like place(), but shears the shape to follow the slope of the ground.
    std::uint16_t placeOnSlope(ObjectClass kind, std::size_t shape, double x_m, double y_m,
                               double yaw_rad, const Eigen::Vector3d& scale);
    /// Adds a shape that is already in the map frame.
    std::uint16_t add(ObjectClass kind, Shape shape);
    /// Adds a moving obstacle unless its circle intersects the path. Returns true if added.
    bool addMover(MovingObstacle mover, double own_radius_m);
    void addRandomMover(MovingObstacle mover);

    /// Calls put(x, y) at random positions of this density.
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
