#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace hagen::simulation {

/// The surface of an object [m], z up: triangles, and round cylinders for thin parts.
struct Shape {
    std::vector<Eigen::Vector3f> vertices_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Eigen::Vector4f> polyline_m;  ///< points of cylinder chains: x, y, z, radius
    /// Index of each cylinder's first point. The cylinder ends at the next point with a ball.
    std::vector<std::uint32_t> segments;

    void addTriangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);
    /// Adds a quadrilateral with its corners in order.
    void addQuad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
                 const Eigen::Vector3f& d);
    void addBox(const Eigen::Vector3f& min_m, const Eigen::Vector3f& max_m);
    /// Adds a polygon in the xz plane, star-shaped about the mean of its corners, extruded along y.
    void addPrism(const std::vector<Eigen::Vector2f>& outline_m, float min_y_m, float max_y_m);
    /// Adds cylinders along a polyline of points with x, y, z and radius [m].
    void addRod(const std::vector<Eigen::Vector4f>& knots);
    /// Like addRod(), but made of triangles with open ends, which is faster for many objects.
    void addTube(const std::vector<Eigen::Vector4f>& knots, int sides);
    /// Adds another shape, transformed. Cylinder radii do not change.
    void append(const Shape& other, const Eigen::Affine3f& pose);
};

}  // namespace hagen::simulation
