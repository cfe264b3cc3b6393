#include "simulation/Plants.h"
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

using Eigen::Vector3d;

Vector3d randomDirection(Random& random) {
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * kPi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Adds an equilateral triangle of random orientation.
void addLeaf(const Vector3d& at, double edge_m, Random& random, Shape& shape) {
    const Vector3d u = randomDirection(random);
    const Vector3d v = u.cross(randomDirection(random)).normalized();
    const double r = edge_m / std::sqrt(3.0);
    const Vector3d a = at + r * u, b = at - 0.5 * r * u + 0.5 * edge_m * v;
    const Vector3d c = at - 0.5 * r * u - 0.5 * edge_m * v;
    shape.addTriangle(a.cast<float>(), b.cast<float>(), c.cast<float>());
}

double leafArea_m2(double edge_m) { return std::sqrt(3.0) / 4 * edge_m * edge_m; }

Eigen::Vector4f knot(const Vector3d& at, double radius_m) {
    return {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z()),
            static_cast<float>(radius_m)};
}

/// The centre line of a trunk, which bends slightly.
class Trunk {
 public:
    Trunk(const TreeParameters& form, Random& random) : form_(form) {
        const double bend = 0.04 * form.height_m, angle = random.uniform(0, 2 * kPi);
        bend_ = {bend * std::cos(angle), bend * std::sin(angle), 0};
        phase_ = random.uniform(2, 5);
    }
    Vector3d at(double z_m) const {
        const double share = z_m / form_.height_m;
        return share * std::sin(phase_ * share) * bend_ + Vector3d(0, 0, z_m);
    }
    double radius_m(double z_m) const {
        const double flare = z_m < 0.25 ? 0.6 * (0.25 - z_m) / 0.25 : 0.0;
        const double taper = 1.0 - 0.8 * std::max(z_m, 0.0) / form_.height_m;
        return form_.trunk_radius_m * (taper + std::min(flare, 0.6));
    }

 private:
    TreeParameters form_;
    Vector3d bend_;
    double phase_;
};

/// Adds a branch that rises outwards. Appends its points with leaves to `leafy`.
void addBranch(const Trunk& trunk, double z_m, double length_m, double radius_m, Random& random,
               Shape& shape, std::vector<Vector3d>& leafy) {
    const double angle = random.uniform(0, 2 * kPi), rise = random.uniform(0.0, 0.7);
    const Vector3d out = Vector3d(std::cos(angle), std::sin(angle), rise).normalized();
    const Vector3d from = trunk.at(z_m);
    const Vector3d elbow = from + 0.5 * length_m * out;
    const Vector3d end =
        elbow + 0.5 * length_m * (out + 0.4 * randomDirection(random)).normalized();
    shape.addTube({knot(from, radius_m), knot(elbow, 0.7 * radius_m), knot(end, 0.25 * radius_m)},
                  3);
    for (const double share : {0.3, 0.6, 0.9}) leafy.push_back(elbow + share * (end - elbow));
    leafy.push_back(from + 0.75 * (elbow - from));
}

}  // namespace

Shape makeTree(const TreeParameters& form, Random& random) {
    Shape shape;
    const Trunk trunk(form, random);
    std::vector<Eigen::Vector4f> knots;
    for (const double z_m : {-0.4, 0.0, 0.12, 0.25, 0.2 * form.height_m, 0.45 * form.height_m,
                             0.7 * form.height_m, 0.95 * form.height_m}) {
        knots.push_back(knot(trunk.at(z_m), trunk.radius_m(z_m)));
    }
    shape.addTube(knots, 8);

    // The crown is widest below its centre. Branches end at its surface.
    std::vector<Vector3d> leafy, sparse;
    const double crown_m = form.height_m - form.crown_base_m;
    for (int i = 0; i < form.branches; ++i) {
        const double share = random.uniform(0, 0.9);
        const double width = std::sqrt(std::max(0.05, 1 - std::pow((share - 0.35) / 0.65, 2)));
        const double length_m = form.crown_radius_m * width * random.uniform(0.75, 1.05);
        const double radius_m = form.trunk_radius_m * random.uniform(0.15, 0.35);
        addBranch(trunk, form.crown_base_m + share * 0.85 * crown_m, length_m, radius_m, random,
                  shape, leafy);
    }
    for (int i = 0; i < form.low_branches; ++i) {
        const double z_m = random.uniform(0.3, 0.95) * form.crown_base_m;
        const double length_m = form.crown_radius_m * random.uniform(0.4, 0.9);
        const double radius_m = form.trunk_radius_m * random.uniform(0.1, 0.25);
        addBranch(trunk, z_m, length_m, radius_m, random, shape, sparse);
    }
    const double clump_m = 0.17 * form.crown_radius_m;
    const auto scatter = [&](const std::vector<Vector3d>& places, double area_m2) {
        const int leaves = static_cast<int>(area_m2 / leafArea_m2(form.leaf_m));
        for (int i = 0; i < leaves && !places.empty(); ++i) {
            const Vector3d offset{random.normal(), random.normal(), random.normal()};
            const Vector3d at =
                places[random.uniformInt(static_cast<int>(places.size()))] + clump_m * offset;
            if (at.z() > 0.2) addLeaf(at, form.leaf_m, random, shape);
        }
    };
    scatter(leafy, form.leaf_area_m2);
    scatter(sparse, 0.02 * form.leaf_area_m2 * form.low_branches);
    return shape;
}

Shape makeShrub(Random& random) {
    constexpr double kLeaf_m = 0.09;
    Shape shape;
    std::vector<Vector3d> clumps;
    for (int i = 0; i < 9; ++i) {
        const Vector3d direction = randomDirection(random);
        const Vector3d end(0.35 * direction.x(), 0.35 * direction.y(), 0.5 + 0.35 * direction.z());
        shape.addTube({knot({0, 0, -0.05}, 0.012), knot(end, 0.004)}, 3);
        clumps.push_back(end);
    }
    for (int i = 0; i < 500; ++i) {
        const Vector3d offset{random.normal(), random.normal(), random.normal()};
        addLeaf(clumps[random.uniformInt(9)] + 0.11 * offset, kLeaf_m, random, shape);
    }
    return shape;
}

Shape makeCanopyPatch(double side_m, Random& random) {
    constexpr double kRow_m = 0.5, kPlant_m = 0.16;
    constexpr int kBlades = 7;
    Shape shape;
    for (double y = 0.5 * kRow_m; y < side_m; y += kRow_m) {
        for (double x = 0.5 * kPlant_m; x < side_m; x += kPlant_m) {
            if (random.chance(0.06)) continue;  // some seeds fail
            const double px = x - side_m / 2 + 0.04 * random.normal();
            const double py = y - side_m / 2 + 0.03 * random.normal();
            const double height = random.uniform(0.65, 1.0);
            for (int i = 0; i < kBlades; ++i) {
                const double angle = random.uniform(0, 2 * kPi),
                             z = height * random.uniform(0, 0.75);
                const Vector3d out(std::cos(angle), std::sin(angle), 0), side(-out.y(), out.x(), 0);
                const Vector3d foot(px, py, z);
                const double reach = random.uniform(0.1, 0.28), rise = random.uniform(0.3, 1.0);
                const Vector3d tip = foot + reach * out + Vector3d(0, 0, rise * (height - z));
                const Vector3d half = 0.5 * random.uniform(0.03, 0.06) * side;
                shape.addTriangle((foot - half).cast<float>(), (foot + half).cast<float>(),
                                  tip.cast<float>());
            }
        }
    }
    return shape;
}

Shape makeTuft(Random& random) {
    Shape shape;
    for (int i = 0; i < 60; ++i) {
        const double angle = random.uniform(0, 2 * kPi), r = 0.25 * std::sqrt(random.uniform());
        const Vector3d foot(r * std::cos(angle), r * std::sin(angle), -0.1);
        const double lean = random.uniform(0, 2 * kPi);
        const Vector3d tip =
            foot + Vector3d(0.15 * std::cos(lean), 0.15 * std::sin(lean), random.uniform(0.5, 1.1));
        const Vector3d half(-0.03 * std::sin(lean), 0.03 * std::cos(lean), 0);
        shape.addTriangle((foot - half).cast<float>(), (foot + half).cast<float>(),
                          tip.cast<float>());
    }
    return shape;
}

}  // namespace hagen::simulation
