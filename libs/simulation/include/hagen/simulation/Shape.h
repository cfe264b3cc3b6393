#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace hagen::simulation {

/// The surface of a thing: triangles, and round cylinders for what is thin. Metres, z up.
struct Shape {
    std::vector<Eigen::Vector3f> vertices_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Eigen::Vector4f> knots_m;  ///< of cylinders: x, y, z, radius
    /// First knots of cylinders; each leads to the next knot, and ends in a ball.
    std::vector<std::uint32_t> segments;

    void addTriangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);
    /// A quadrilateral, corners in order.
    void addQuad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
                 const Eigen::Vector3f& d);
    void addBox(const Eigen::Vector3f& least_m, const Eigen::Vector3f& most_m);
    /// A polygon in the xz plane, star-shaped about the mean of its corners, drawn out along y.
    void addPrism(const std::vector<Eigen::Vector2f>& outline_m, float least_y_m, float most_y_m);
    /// Cylinders from knot to knot.
    void addRod(const std::vector<Eigen::Vector4f>& knots_m);
    /// The same of triangles, with so many sides and open ends: faster to cast in a crowd.
    void addTube(const std::vector<Eigen::Vector4f>& knots_m, int sides);
    /// Another shape, moved there. Radii of cylinders stay.
    void append(const Shape& other, const Eigen::Affine3f& pose);
};

}  // namespace hagen::simulation
