#include <hagen/scan/Angle.h>
#include <hagen/simulation/Shape.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {

using Eigen::Vector3f;

void Shape::addTriangle(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    const auto first = static_cast<std::uint32_t>(vertices_m.size());
    vertices_m.insert(vertices_m.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
}

void Shape::addQuad(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d) {
    const auto first = static_cast<std::uint32_t>(vertices_m.size());
    vertices_m.insert(vertices_m.end(), {a, b, c, d});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
}

void Shape::addBox(const Vector3f& min_m, const Vector3f& max_m) {
    addPrism({{min_m.x(), min_m.z()},
              {max_m.x(), min_m.z()},
              {max_m.x(), max_m.z()},
              {min_m.x(), max_m.z()}},
             min_m.y(), max_m.y());
}

void Shape::addPrism(const std::vector<Eigen::Vector2f>& outline_m, float min_y_m, float max_y_m) {
    const auto at = [](const Eigen::Vector2f& p, float y) { return Vector3f(p.x(), y, p.y()); };
    Eigen::Vector2f middle = Eigen::Vector2f::Zero();
    for (const Eigen::Vector2f& corner : outline_m) middle += corner;
    middle /= static_cast<float>(outline_m.size());
    for (std::size_t i = 0; i < outline_m.size(); ++i) {
        const Eigen::Vector2f &p = outline_m[i], &q = outline_m[(i + 1) % outline_m.size()];
        addQuad(at(p, min_y_m), at(q, min_y_m), at(q, max_y_m), at(p, max_y_m));
        addTriangle(at(p, min_y_m), at(q, min_y_m), at(middle, min_y_m));
        addTriangle(at(p, max_y_m), at(q, max_y_m), at(middle, max_y_m));
    }
}

void Shape::addRod(const std::vector<Eigen::Vector4f>& knots) {
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (i + 1 < knots.size()) segments.push_back(static_cast<std::uint32_t>(polyline_m.size()));
        polyline_m.push_back(knots[i]);
    }
}

void Shape::addTube(const std::vector<Eigen::Vector4f>& knots, int sides) {
    const auto first = static_cast<std::uint32_t>(vertices_m.size());
    const auto count = static_cast<std::uint32_t>(sides);
    for (std::size_t i = 0; i < knots.size(); ++i) {
        const Eigen::Vector4f &before = knots[i > 0 ? i - 1 : 0], &at = knots[i];
        const Eigen::Vector4f& after = knots[std::min(i + 1, knots.size() - 1)];
        const Vector3f along = (after - before).head<3>().normalized();
        const Vector3f aside = along.unitOrthogonal(), other = along.cross(aside);
        for (int side = 0; side < sides; ++side) {
            const auto angle = static_cast<float>(2 * kPi * side / sides);
            vertices_m.push_back(at.head<3>() +
                                 at.w() * (std::cos(angle) * aside + std::sin(angle) * other));
        }
    }
    for (std::uint32_t i = 0; i + 1 < knots.size(); ++i) {
        for (std::uint32_t side = 0; side < count; ++side) {
            const std::uint32_t a = first + i * count + side;
            const std::uint32_t b = first + i * count + (side + 1) % count;
            triangles.push_back({a, b, b + count});
            triangles.push_back({a, b + count, a + count});
        }
    }
}

void Shape::append(const Shape& other, const Eigen::Affine3f& pose) {
    const auto first_vertex = static_cast<std::uint32_t>(vertices_m.size());
    const auto first_knot = static_cast<std::uint32_t>(polyline_m.size());
    for (const Vector3f& vertex : other.vertices_m) vertices_m.push_back(pose * vertex);
    for (const auto& t : other.triangles) {
        triangles.push_back({first_vertex + t[0], first_vertex + t[1], first_vertex + t[2]});
    }
    for (const Eigen::Vector4f& knot : other.polyline_m) {
        const Vector3f moved = pose * Vector3f(knot.head<3>());
        polyline_m.emplace_back(moved.x(), moved.y(), moved.z(), knot.w());
    }
    for (const std::uint32_t segment : other.segments) segments.push_back(first_knot + segment);
}

}  // namespace hagen::simulation
