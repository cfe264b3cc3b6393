#include "simulation/Props.h"
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kFoot_m = -0.4f;  // objects extend into the ground, to avoid gaps on slopes

Eigen::Vector4f knot(double x, double y, double z, double radius) {
    return Eigen::Vector4d(x, y, z, radius).cast<float>();
}

Shape wheel() {
    std::vector<Vector2f> outline;
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * kPi * i / 12;
        outline.emplace_back(static_cast<float>(0.32 * std::cos(angle)),
                             static_cast<float>(0.32 + 0.32 * std::sin(angle)));
    }
    Shape shape;
    shape.addPrism(outline, -0.1f, 0.1f);
    return shape;
}

}  // namespace

Shape makeRod(double height_m, double radius_m) {
    Shape shape;
    shape.addRod({knot(0, 0, -0.4, radius_m), knot(0, 0, 0.5 * height_m, 0.9 * radius_m),
                  knot(0, 0, height_m, 0.8 * radius_m)});
    return shape;
}

Shape makeCar(Random& random) {
    const auto h = static_cast<float>(random.uniform(0.95, 1.3));  // from saloon to van
    Shape shape;
    shape.addPrism({{-2.1f, 0.28f},
                    {2.1f, 0.28f},
                    {2.1f, 0.72f},
                    {1.15f, 0.92f * h},
                    {0.55f, 1.42f * h},
                    {-1.2f, 1.45f * h},
                    {-1.75f, 0.98f * h},
                    {-2.1f, 0.8f}},
                   -0.86f, 0.86f);
    for (const float x : {-1.35f, 1.35f}) {
        for (const float y : {-0.78f, 0.78f}) {
            shape.append(wheel(), Eigen::Affine3f(Eigen::Translation3f(x, y, 0)));
        }
    }
    return shape;
}

Shape makeHouse(double length_m, double width_m, double wall_m, Random& random) {
    const auto l = static_cast<float>(length_m / 2), w = static_cast<float>(width_m / 2);
    const auto h = static_cast<float>(wall_m);
    Shape shape;
    shape.addBox({-l, -w, 3 * kFoot_m}, {l, w, h});
    shape.addPrism({{-l - 0.3f, h}, {l + 0.3f, h}, {0, h + 0.45f * l}}, -w - 0.3f, w + 0.3f);
    for (float x = -l + 1.5f; x < l - 1.0f; x += 3.0f) {  // window sills, balconies and awnings
        for (const float side : {-1.0f, 1.0f}) {
            if (random.chance(0.4)) continue;
            const auto z = static_cast<float>(random.uniform(0.9, 0.8 * wall_m));
            const auto out = static_cast<float>(random.uniform(0.15, 1.0));
            shape.addBox({x - 0.7f, std::min(side * w, side * (w + out)), z},
                         {x + 0.7f, std::max(side * w, side * (w + out)), z + 0.12f});
        }
    }
    return shape;
}

Shape makeRock(Random& random) {
    constexpr int kRings = 6, kSides = 10;
    const auto corner = [&](int ring, double angle) {
        const double up = kPi * (static_cast<double>(ring) / kRings - 0.5);
        const double r = random.uniform(0.38, 0.55);
        return Eigen::Vector3d(r * std::cos(up) * std::cos(angle),
                               r * std::cos(up) * std::sin(angle), r * std::sin(up) + 0.25);
    };
    Shape shape;
    for (int ring = 0; ring <= kRings; ++ring) {
        for (int side = 0; side < kSides; ++side) {
            shape.vertices_m.push_back(corner(ring, 2 * kPi * side / kSides).cast<float>());
        }
    }
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const std::uint32_t next = (side + 1) % kSides, low = ring * kSides;
            const std::uint32_t high = low + kSides;
            shape.triangles.push_back({low + side, low + next, high + next});
            shape.triangles.push_back({low + side, high + next, high + side});
        }
    }
    return shape;
}

Shape makePerson() {
    Shape shape;
    shape.addRod({knot(0.12, 0.09, 0.03, 0.06), knot(0, 0.08, 0.85, 0.08)});
    shape.addRod({knot(-0.12, -0.09, 0.03, 0.06), knot(0, -0.08, 0.85, 0.08)});
    shape.addRod({knot(0, 0, 0.95, 0.16), knot(0, 0, 1.35, 0.17)});
    shape.addRod({knot(0, 0.2, 1.4, 0.05), knot(0.1, 0.25, 0.9, 0.04)});
    shape.addRod({knot(0, -0.2, 1.4, 0.05), knot(-0.1, -0.25, 0.9, 0.04)});
    shape.addRod({knot(0, 0, 1.6, 0.1), knot(0, 0, 1.68, 0.1)});
    return shape;
}

Shape makeDrone() {
    Shape shape;
    shape.addBox({-0.15f, -0.15f, -0.06f}, {0.15f, 0.15f, 0.1f});
    shape.addRod({knot(-0.35, -0.35, 0.05, 0.02), knot(0.35, 0.35, 0.05, 0.02)});
    shape.addRod({knot(-0.35, 0.35, 0.05, 0.02), knot(0.35, -0.35, 0.05, 0.02)});
    return shape;
}

void addWall(SceneBuilder& builder, const Vector2d& from_m, const Vector2d& to_m, double height_m,
             double thickness_m) {
    const Vector2d along = to_m - from_m;
    const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / 2.0)));
    const auto half = static_cast<float>(0.5 * along.norm() / pieces);
    Shape piece, wall;
    piece.addBox({-half, static_cast<float>(-thickness_m / 2), 2 * kFoot_m},
                 {half, static_cast<float>(thickness_m / 2), static_cast<float>(height_m)});
    for (int i = 0; i < pieces; ++i) {
        const Vector2d at = from_m + (i + 0.5) / pieces * along;
        const Eigen::Affine3d pose =
            Eigen::Translation3d(at.x(), at.y(), builder.terrain().height_m(at.x(), at.y())) *
            Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ());
        wall.append(piece, pose.cast<float>());
    }
    builder.add(ObjectClass::Wall, std::move(wall));
}

void addTrap(SceneBuilder& builder, const Vector2d& back_m, double yaw_rad, double width_m,
             double depth_m, double height_m) {
    const Vector2d out(std::cos(yaw_rad), std::sin(yaw_rad)), side(-out.y(), out.x());
    const Vector2d left = back_m + 0.5 * width_m * side, right = back_m - 0.5 * width_m * side;
    addWall(builder, left, right, height_m, 0.3);
    addWall(builder, left, left + depth_m * out, height_m, 0.3);
    addWall(builder, right, right + depth_m * out, height_m, 0.3);
}

void addWireLine(SceneBuilder& builder, const Vector2d& from_m, const Vector2d& to_m, double span_m,
                 const std::vector<double>& heights_m, double sideways_m, double radius_m) {
    constexpr double kSag = 0.02;
    constexpr int kPieces = 12;
    const Vector2d along = to_m - from_m;
    const Vector2d across = Vector2d(-along.y(), along.x()).normalized();
    const int spans = std::max(1, static_cast<int>(std::lround(along.norm() / span_m)));
    const double tallest_m = *std::max_element(heights_m.begin(), heights_m.end());
    const std::size_t pole = builder.addShape(makeRod(tallest_m + 0.4, 0.12));
    const auto ground_m = [&](const Vector2d& at) {
        return builder.terrain().height_m(at.x(), at.y());
    };
    for (int i = 0; i <= spans; ++i) {
        const Vector2d at = from_m + along * i / spans;
        builder.place(ObjectClass::Pole, pole, at.x(), at.y(), 0);
    }
    for (std::size_t wire = 0; wire < heights_m.size(); ++wire) {
        const Vector2d aside = across * (wire % 2 == 0 ? -sideways_m : sideways_m);
        Shape shape;
        for (int i = 0; i < spans; ++i) {
            const Vector2d p = from_m + along * i / spans, q = from_m + along * (i + 1) / spans;
            std::vector<Eigen::Vector4f> knots;
            for (int k = 0; k <= kPieces; ++k) {
                const double share = static_cast<double>(k) / kPieces;
                const Vector2d at = p + share * (q - p) + aside;
                const double hung_m = heights_m[wire] + (1 - share) * ground_m(p) +
                                      share * ground_m(q) -
                                      4 * kSag * (q - p).norm() * share * (1 - share);
                knots.push_back(knot(at.x(), at.y(), hung_m, radius_m));
            }
            shape.addRod(knots);
        }
        builder.add(ObjectClass::Wire, std::move(shape));
    }
}

}  // namespace hagen::simulation
