#include "avoidance/flights/CourseScenes.h"

#include <hagen/scan/Angle.h>
#include <cmath>
#include "simulation/Plants.h"
#include "simulation/Props.h"

namespace hagen::avoidance {
namespace {

using Eigen::Vector2d;
using Shapes = std::vector<std::size_t>;

/// Only the ground below the flight is finely meshed, so that generating and scanning scenes is
/// fast.
constexpr simulation::GroundExtent kGround{48, 20, 90};

simulation::SceneBuilder groundOf(double slope_deg, double bump_m, double grass_m,
                                  const simulation::Random& random) {
    simulation::TerrainParameters form;
    form.max_slope_rad = radians(slope_deg);
    form.bump_m = bump_m;
    form.roughness_m = 0.025;
    form.grass_m = grass_m;
    return simulation::SceneBuilder(form, kGround, random);
}

double anyYaw(simulation::Random& random) { return random.uniform(0, 2 * kPi); }

double anySign(simulation::Random& random) { return random.chance(0.5) ? 1.0 : -1.0; }

Vector2d anywhere(simulation::Random& random) {
    const double x_m = random.uniform(kCourseField_m.min().x(), kCourseField_m.max().x());
    const double y_m = random.uniform(kCourseField_m.min().y(), kCourseField_m.max().y());
    return {x_m, y_m};
}

/// Whether an object of this radius at a place leaves start and goal free.
bool leavesEndsFree(const Vector2d& at_m, double radius_m) {
    const double near_m = radius_m + kFreeAtEnds_m;
    return (at_m - kCourseStart_m).norm() > near_m && (at_m - kCourseGoal_m).norm() > near_m;
}

/// Calls put(place) at random places, with this density over the field (a Poisson process).
template <class Put>
void scatter(simulation::SceneBuilder& builder, double per_m2, const Put& put) {
    const int count = builder.random().poisson(per_m2 * kCourseField_m.volume());
    for (int i = 0; i < count; ++i) put(anywhere(builder.random()));
}

/// A forest tree with fewer and larger leaves than in the scenarios.
simulation::TreeParameters lightTree(simulation::Random& random) {
    simulation::TreeParameters form;
    form.height_m = random.uniform(5.5, 9.0);
    form.crown_base_m = random.uniform(2.4, 4.0);
    form.crown_radius_m = random.uniform(0.9, 1.5);
    form.trunk_radius_m = 0.015 * form.height_m * random.uniform(0.8, 1.4);
    form.leaf_m = 0.5;
    form.leaf_area_m2 = 2.0 * form.crown_radius_m * (form.height_m - form.crown_base_m);
    form.branches = 8;
    form.low_branches = random.uniformInt(3);
    return form;
}

constexpr double kMaxTreeWidth_m = 1.9;  // width of crown and leaf clumps at the largest scale

Shapes addTrees(simulation::SceneBuilder& builder, int count) {
    return builder.addShapes(
        count, [](simulation::Random& r) { return simulation::makeTree(lightTree(r), r); });
}

/// Places trees wherever `mayStand` allows.
template <class MayStand>
void scatterTrees(simulation::SceneBuilder& builder, double per_m2, const MayStand& mayStand) {
    const Shapes trees = addTrees(builder, 6);
    scatter(builder, per_m2, [&](const Vector2d& at) {
        const double size = builder.random().uniform(0.8, 1.15);
        if (!leavesEndsFree(at, kMaxTreeWidth_m) || !mayStand(at)) return;
        builder.placeRandomOf(simulation::ObjectClass::Tree, trees, at.x(), at.y(),
                              {size, size, size});
    });
}

void scatterTrees(simulation::SceneBuilder& builder, double per_m2) {
    scatterTrees(builder, per_m2, [](const Vector2d&) { return true; });
}

void scatterTufts(simulation::SceneBuilder& builder, double per_m2, double tallest_m) {
    const Shapes tufts = builder.addShapes(3, simulation::makeTuft);
    scatter(builder, per_m2, [&](const Vector2d& at) {
        const double height_m = builder.random().uniform(0.1, tallest_m);
        builder.placeRandomOf(simulation::ObjectClass::Canopy, tufts, at.x(), at.y(),
                              {1, 1, height_m});
    });
}

simulation::Scene makeForest(double per_m2, const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(4, 0.05, 0.12, random);
    scatterTrees(builder, per_m2);
    scatterTufts(builder, 0.02, 0.35);
    return builder.build();
}

/// Rows 4 m apart with a tree every 3 m, at an angle to the path: the vehicle must change rows
/// where trees are missing.
simulation::Scene makeOrchard(simulation::Random random) {
    simulation::SceneBuilder builder = groundOf(3, 0.04, 0.15, random);
    simulation::Random& r = builder.random();
    const Shapes trees = builder.addShapes(5, [](simulation::Random& own) {
        simulation::TreeParameters form;
        form.height_m = own.uniform(3.8, 4.6);
        form.crown_base_m = own.uniform(0.6, 1.0);
        form.crown_radius_m = own.uniform(0.8, 1.1);
        form.trunk_radius_m = own.uniform(0.05, 0.09);
        form.leaf_m = 0.4;
        form.leaf_area_m2 = own.uniform(7, 10);
        form.branches = 9;
        form.low_branches = own.uniformInt(2);
        return simulation::makeTree(form, own);
    });
    constexpr double kRow_m = 4, kTree_m = 3, kMissing = 0.15;
    const double yaw = anySign(r) * radians(r.uniform(10, 30)), aside_m = r.uniform(0, kRow_m);
    const Vector2d along(std::cos(yaw), std::sin(yaw)), across(-along.y(), along.x());
    for (int row = -12; row <= 12; ++row) {
        for (int tree = -20; tree <= 20; ++tree) {
            const double x_m = 0.12 * r.normal(), y_m = 0.08 * r.normal();
            const Vector2d at = kCourseField_m.center() + (tree * kTree_m + x_m) * along +
                                (row * kRow_m + aside_m + y_m) * across;
            const double size = r.uniform(0.9, 1.05);
            if (r.chance(kMissing) || !kCourseField_m.contains(at)) continue;
            if (!leavesEndsFree(at, 1.6)) continue;
            builder.placeRandomOf(simulation::ObjectClass::Tree, trees, at.x(), at.y(),
                                  {size, size, size});
        }
    }
    scatterTufts(builder, 0.02, 0.25);
    return builder.build();
}

constexpr double kWallHeight_m = 6;  // above the altitude limit
constexpr double kBesideField_m = 19;

/// A wall across the field with a gap off the straight line, and a few trees.
simulation::Scene makeGap(const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(2, 0.03, 0.1, random);
    simulation::Random& r = builder.random();
    const double side = anySign(r), x_m = r.uniform(14, 26), skew = r.uniform(-0.2, 0.2);
    const double y_m = side * r.uniform(1.5, 9);
    const double gap_m = r.uniform(1.6, 2.4), thickness_m = r.uniform(0.15, 0.4);
    const Vector2d middle(x_m, y_m), along(std::sin(skew), std::cos(skew));
    simulation::addWall(builder, middle + gap_m / 2 * along,
                        middle + (kBesideField_m - y_m) / along.y() * along, kWallHeight_m,
                        thickness_m);
    simulation::addWall(builder, middle - (kBesideField_m + y_m) / along.y() * along,
                        middle - gap_m / 2 * along, kWallHeight_m, thickness_m);
    scatterTrees(builder, 0.006, [&](const Vector2d& at) {
        return (at - middle).norm() > 5 && std::abs(at.x() - x_m) > 2.5;
    });
    scatterTufts(builder, 0.02, 0.3);
    return builder.build();
}

/// A U of three walls, open towards the start: the path leads back out and around it.
simulation::Scene makeTrap(const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(2, 0.03, 0.12, random);
    simulation::Random& r = builder.random();
    const double x_m = r.uniform(23, 28), y_m = r.uniform(-1.5, 1.5);
    const double yaw = kPi + r.uniform(-0.25, 0.25);
    const double width_m = r.uniform(9, 11), depth_m = r.uniform(8, 10);
    simulation::addTrap(builder, {x_m, y_m}, yaw, width_m, depth_m, kWallHeight_m);
    const Vector2d middle =
        Vector2d(x_m, y_m) + depth_m / 2 * Vector2d(std::cos(yaw), std::sin(yaw));
    scatterTrees(builder, 0.01, [&](const Vector2d& at) { return (at - middle).norm() > 10; });
    scatterTufts(builder, 0.02, 0.3);
    return builder.build();
}

simulation::Scene makeTerrain(const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(15, 0.06, 0.15, random);
    simulation::Random& r = builder.random();
    scatterTrees(builder, 0.03);
    const Shapes rocks = builder.addShapes(4, simulation::makeRock);
    scatter(builder, 0.012, [&](const Vector2d& at) {
        const double size = r.uniform(0.5, 2.2), wide = r.uniform(0.7, 1.3);
        const double high = r.uniform(0.5, 1.0);
        if (!leavesEndsFree(at, 0.7 * size)) return;
        builder.placeRandomOf(simulation::ObjectClass::Wall, rocks, at.x(), at.y(),
                              {size, size * wide, size * high});
    });
    scatterTufts(builder, 0.02, 0.35);
    return builder.build();
}

/// Rows of poles across the path, with one wire at about flight altitude and others above.
simulation::Scene makeWires(double radius_m, const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(3, 0.04, 0.12, random);
    simulation::Random& r = builder.random();
    for (double x_m = 8; x_m <= 34; x_m += 8.5) {
        const double at_m = x_m + r.uniform(-2, 2), skew_m = r.uniform(-4, 4);
        const double span_m = r.uniform(9, 14), first_m = r.uniform(-26, -18);
        const Vector2d from(at_m - skew_m / 2, first_m), step(skew_m / 40, 1);
        const double length_m = 4 * span_m;
        std::vector<double> heights_m{r.uniform(1.9, 2.7)};
        heights_m.push_back(heights_m[0] + r.uniform(0.8, 1.6));
        if (r.chance(0.5)) heights_m.push_back(heights_m[1] + r.uniform(0.8, 1.6));
        const double sideways_m = r.uniform(0.05, 0.3);
        simulation::addWireLine(builder, from, from + length_m * step, span_m, heights_m,
                                sideways_m, radius_m);
    }
    scatterTrees(builder, 0.006);
    scatterTufts(builder, 0.02, 0.3);
    return builder.build();
}

constexpr double kMaxMoverLength_m = 2.3;  // half a car's length

/// Adds movers whose circles cross the path, but not near its ends.
template <class ShapeOf>
void addMovers(simulation::SceneBuilder& builder, int count, const simulation::MovingObstacle& min,
               const simulation::MovingObstacle& max, const ShapeOf& shapeOf) {
    simulation::Random& r = builder.random();
    for (int made = 0; made < count;) {
        simulation::MovingObstacle mover;
        const double x_m = r.uniform(2, 38), y_m = r.uniform(-4, 4);
        mover.middle_m = {x_m, y_m};
        mover.radius_m = r.uniform(min.radius_m, max.radius_m);
        mover.speed_m_s = r.uniform(min.speed_m_s, max.speed_m_s) * anySign(r);
        mover.above_ground_m = r.uniform(min.above_ground_m, max.above_ground_m);
        mover.phase_rad = anyYaw(r);
        mover.shape = shapeOf();
        const auto comesNear = [&](const Vector2d& end_m) {
            return std::abs((end_m - mover.middle_m).norm() - mover.radius_m) <
                   kFreeAtEnds_m + kMaxMoverLength_m;
        };
        if (std::abs(y_m) > mover.radius_m - 0.5 || comesNear(kCourseStart_m) ||
            comesNear(kCourseGoal_m)) {
            continue;
        }
        builder.addRandomMover(mover);
        ++made;
    }
}

simulation::MovingObstacle moverOf(double radius_m, double speed_m_s, double above_ground_m) {
    simulation::MovingObstacle mover;
    mover.radius_m = radius_m;
    mover.speed_m_s = speed_m_s;
    mover.above_ground_m = above_ground_m;
    return mover;
}

simulation::Scene makeMovers(const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(2, 0.03, 0.1, random);
    const std::size_t person = builder.addShape(simulation::makePerson());
    const std::size_t drone = builder.addShape(simulation::makeDrone());
    const Shapes cars = builder.addShapes(2, simulation::makeCar);
    addMovers(builder, 3, moverOf(2.5, 1, 0), moverOf(8, 2, 0), [&] { return person; });
    addMovers(builder, 1, moverOf(5, 1.5, 0), moverOf(10, 3, 0),
              [&] { return builder.randomOf(cars); });
    addMovers(builder, 2, moverOf(3, 1.5, 1), moverOf(8, 3, 2.5), [&] { return drone; });
    scatterTrees(builder, 0.008);
    scatterTufts(builder, 0.02, 0.3);
    return builder.build();
}

/// Garden walls that reach into the street from both sides.
void addGardenWalls(simulation::SceneBuilder& builder) {
    simulation::Random& r = builder.random();
    for (const double side : {-1.0, 1.0}) {
        for (double x_m = 6; x_m < 38; x_m += r.uniform(7, 12)) {
            const double inner_m = r.uniform(3.5, 8), skew_m = r.uniform(-1, 1);
            const double height_m = r.uniform(1.5, 3.5);
            simulation::addWall(builder, {x_m, side * inner_m},
                                {x_m + skew_m, side * kBesideField_m}, height_m, 0.25);
        }
    }
}

/// Parked cars, even in the middle of the street; lamps, trees and walls.
simulation::Scene makeStreet(const simulation::Random& random) {
    simulation::SceneBuilder builder = groundOf(2, 0.02, 0.08, random);
    simulation::Random& r = builder.random();
    const Shapes cars = builder.addShapes(5, simulation::makeCar);
    for (const double lane_m : {-7.0, -2.6, 0.0, 2.6, 7.0}) {
        for (double x_m = -4; x_m <= 46; x_m += 6.2) {
            const double dx_m = r.uniform(-0.8, 0.8), dy_m = 0.3 * r.normal();
            const double yaw = (r.chance(0.5) ? 0.0 : kPi) + 0.05 * r.normal();
            const Vector2d at(x_m + dx_m, lane_m + dy_m);
            if (r.chance(0.55) || !leavesEndsFree(at, 2.4)) continue;
            builder.place(simulation::ObjectClass::Vehicle, builder.randomOf(cars), at.x(), at.y(),
                          yaw);
        }
    }
    addGardenWalls(builder);
    const std::size_t lamp = builder.addShape(simulation::makeRod(6.5, 0.08));
    const Shapes trees = addTrees(builder, 4);
    for (double x_m = -4; x_m <= 46; x_m += 10) {
        for (const double y_m : {-4.8, 4.8}) {
            const Vector2d at(x_m + r.uniform(-3, 3), y_m + 0.2 * r.normal());
            const bool is_tree = r.chance(0.5);
            if (!leavesEndsFree(at, is_tree ? kMaxTreeWidth_m : 0.1)) continue;
            if (is_tree)
                builder.placeRandomOf(simulation::ObjectClass::Tree, trees, at.x(), at.y());
            if (!is_tree) builder.place(simulation::ObjectClass::Pole, lamp, at.x(), at.y(), 0);
        }
    }
    return builder.build();
}

}  // namespace

const std::vector<CourseKind>& courseKinds() {
    static const std::vector<CourseKind> kinds{
        {"forest-0.02", 2, [](simulation::Random random) { return makeForest(0.02, random); }},
        {"forest-0.05", 2, [](simulation::Random random) { return makeForest(0.05, random); }},
        {"forest-0.10", 2, [](simulation::Random random) { return makeForest(0.10, random); }},
        {"orchard", 2.5, [](simulation::Random random) { return makeOrchard(random); }},
        {"gap", 2, [](simulation::Random random) { return makeGap(random); }},
        {"u-trap", 2, [](simulation::Random random) { return makeTrap(random); }},
        {"terrain", 2, [](simulation::Random random) { return makeTerrain(random); }},
        {"wires", 2,
         [](simulation::Random random) { return makeWires(simulation::kWireRadius_m, random); }},
        {"wires-thin", 2, [](simulation::Random random) { return makeWires(0.0025, random); }},
        {"movers", 1.5, [](simulation::Random random) { return makeMovers(random); }},
        {"street", 1.5, [](simulation::Random random) { return makeStreet(random); }}};
    return kinds;
}

}  // namespace hagen::avoidance
