#include <hagen/scan/Angle.h>
#include <hagen/simulation/Scenarios.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include "simulation/Plants.h"
#include "simulation/Props.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector2d;
using Shapes = std::vector<std::size_t>;

double anyYaw(Random& random) { return random.uniform(0, 2 * kPi); }

/// Scatters tufts of grass and weeds, 0.1 m to `tallest_m` high.
void scatterTufts(SceneBuilder& builder, double per_m2, double tallest_m) {
    const Shapes tufts = builder.addShapes(3, makeTuft);
    builder.scatter(per_m2, [&](double x, double y) {
        const double size = builder.random().uniform(0.6, 1.6);
        builder.placeRandomOf(ObjectClass::Canopy, tufts, x, y,
                              {size, size, builder.random().uniform(0.1, tallest_m)});
    });
}

void scatterTuftsAround(SceneBuilder& builder, const Shapes& tufts, double x, double y, int count,
                        double tallest_m) {
    Random& random = builder.random();
    for (int i = 0; i < count; ++i) {
        const double angle = anyYaw(random), r = random.uniform(0.1, 0.6);
        builder.placeRandomOf(
            ObjectClass::Canopy, tufts, x + r * std::cos(angle), y + r * std::sin(angle),
            {random.uniform(0.6, 1.3), random.uniform(0.6, 1.3), random.uniform(0.12, tallest_m)});
    }
}

TreeParameters forestTree(Random& random) {
    TreeParameters form;
    form.height_m = random.uniform(6, 12);
    form.crown_base_m = random.uniform(1.8, 3.5);
    form.crown_radius_m = random.uniform(1.2, 2.1);
    form.trunk_radius_m = 0.013 * form.height_m * random.uniform(0.8, 1.4);
    form.leaf_area_m2 = 3.0 * form.crown_radius_m * (form.height_m - form.crown_base_m);
    form.leaf_m = 0.24;
    form.branches = 26;
    form.low_branches = random.uniformInt(5);
    return form;
}

/// Scatters trees of several shapes. `crown_m`: maximum crown radius.
void scatterTrees(SceneBuilder& builder, const Shapes& trees, double per_m2, double crown_m) {
    Random& random = builder.random();
    builder.scatter(per_m2, [&](double x, double y) {
        const double size = random.uniform(0.7, 1.15);
        if (!builder.isFree(x, y, size * crown_m)) return;
        builder.placeRandomOf(ObjectClass::Tree, trees, x, y,
                              {size, size, size * random.uniform(0.85, 1.15)});
    });
}

void scatterShrubs(SceneBuilder& builder, double per_m2, double tallest_m) {
    Random& random = builder.random();
    const Shapes shrubs = builder.addShapes(3, makeShrub);
    builder.scatter(per_m2, [&](double x, double y) {
        const double width = random.uniform(0.6, 1.6);
        if (!builder.isFree(x, y, 0.6 * width)) return;
        builder.placeRandomOf(ObjectClass::Tree, shrubs, x, y,
                              {width, width, random.uniform(0.4, tallest_m)});
    });
}

/// Adds trees and houses at 55 to 110 m.
void addBackground(SceneBuilder& builder, const Shapes& trees) {
    Random& random = builder.random();
    for (int i = 0; i < 110; ++i) {
        const double angle = anyYaw(random), r = random.uniform(60, 105);
        const double size = random.uniform(0.8, 1.4);
        builder.placeRandomOf(ObjectClass::Tree, trees, r * std::cos(angle), r * std::sin(angle),
                              {size, size, size});
    }
    for (int i = 0; i < 4; ++i) {
        const double angle = anyYaw(random), r = random.uniform(65, 95);
        const double length_m = random.uniform(8, 18), width_m = random.uniform(7, 10);
        const double wall_m = random.uniform(3, 6);
        const std::size_t house = builder.addShape(makeHouse(length_m, width_m, wall_m, random));
        builder.place(ObjectClass::Building, house, r * std::cos(angle), r * std::sin(angle),
                      anyYaw(random));
    }
}

Shapes addForestTrees(SceneBuilder& builder, int count) {
    return builder.addShapes(count,
                             [](Random& random) { return makeTree(forestTree(random), random); });
}

/// Scatters trees, shrubs and grass among other objects, and adds the background.
void addSurroundings(SceneBuilder& builder, double trees_per_m2, double tallest_shrub_m) {
    const Shapes trees = addForestTrees(builder, 3);
    scatterTrees(builder, trees, trees_per_m2, 2.2);
    scatterShrubs(builder, 0.004, tallest_shrub_m);
    scatterTufts(builder, 0.1, 0.3);
    addBackground(builder, trees);
}

TerrainParameters ground(double slope_deg, double bump_m, double roughness_m, double grass_m) {
    TerrainParameters form;
    form.max_slope_rad = radians(slope_deg);
    form.bump_m = bump_m;
    form.roughness_m = roughness_m;
    form.grass_m = grass_m;
    return form;
}

Scene makeOrchard(std::uint64_t seed) {
    SceneBuilder builder(ground(4, 0.04, 0.025, 0.15), {30, 12.5}, seed);
    Random& random = builder.random();
    const Shapes trees = builder.addShapes(5, [](Random& r) {
        TreeParameters form;
        form.height_m = r.uniform(3.0, 4.2);
        form.crown_base_m = r.uniform(0.6, 1.0);
        form.crown_radius_m = r.uniform(1.1, 1.55);
        form.trunk_radius_m = r.uniform(0.05, 0.09);
        form.leaf_area_m2 = r.uniform(9, 15);
        form.low_branches = r.uniformInt(4);
        return makeTree(form, r);
    });
    const Shapes tufts = builder.addShapes(3, makeTuft);
    const std::size_t stake = builder.addShape(makeRod(2.2, 0.04));
    constexpr double kRow_m = 5.0, kTree_m = 3.2;
    for (int row = -7; row <= 7; ++row) {
        for (double at = -37; at <= 37; at += kTree_m) {
            const double x = at + 0.15 * random.normal(), y = row * kRow_m + 0.08 * random.normal();
            if (random.chance(0.07)) continue;  // a dead tree
            const double size = random.uniform(0.75, 1.1);
            if (!builder.isFree(x, y, 1.45 * size)) continue;
            builder.placeRandomOf(ObjectClass::Tree, trees, x, y,
                                  {size, size, size * random.uniform(0.85, 1.1)});
            scatterTuftsAround(builder, tufts, x, y, 3, 0.35);
            if (random.chance(0.3) && builder.isFree(x + 1.6, y, 0.1)) {
                builder.place(ObjectClass::Pole, stake, x + 1.6, y, 0);
            }
        }
    }
    scatterTufts(builder, 0.08, 0.25);
    const Shapes tall = addForestTrees(builder, 2);
    for (double y = -45; y <= 45; y += 3.2) {  // a windbreak
        const double x = 58 + random.normal();
        builder.placeRandomOf(ObjectClass::Tree, tall, x, y);
    }
    const std::size_t car = builder.addShape(makeCar(random));
    builder.placeRandomOf(ObjectClass::Vehicle, {car}, -47, 5);
    addBackground(builder, tall);
    return builder.build();
}

Scene makeField(std::uint64_t seed) {
    SceneBuilder builder(ground(6, 0.05, 0.03, 0.08), {35, 16}, seed);
    Random& random = builder.random();
    constexpr double kPatch_m = 5;
    const Shapes patches =
        builder.addShapes(4, [](Random& r) { return makeCanopyPatch(kPatch_m, r); });
    const double phase = anyYaw(random), other = anyYaw(random);
    for (double x = -60; x <= 60; x += kPatch_m) {
        for (double y = -45; y <= 45; y += kPatch_m) {
            if (random.chance(0.05)) continue;  // bare
            const double swell = std::sin(x / 9 + phase) + std::sin(y / 13 - x / 21 + other);
            const double height = std::clamp(0.6 + 0.17 * swell, 0.3, 0.9);
            const std::size_t patch = builder.randomOf(patches);
            builder.placeOnSlope(ObjectClass::Canopy, patch, x, y, random.chance(0.5) ? kPi : 0.0,
                                 {1, 1, height});
        }
    }
    const Shapes trees = addForestTrees(builder, 3);
    scatterTrees(builder, trees, 0.0015, 2.2);
    const std::size_t pole = builder.addShape(makeRod(7, 0.13));
    const std::size_t stake = builder.addShape(makeRod(1.8, 0.05));
    for (double x = -60; x <= 60; x += 20) builder.place(ObjectClass::Pole, pole, x, -28, 0);
    builder.scatter(0.001, [&](double x, double y) {
        if (builder.isFree(x, y, 0.3)) builder.place(ObjectClass::Pole, stake, x, y, 0);
    });
    const Shapes hedge = builder.addShapes(4, makeShrub);
    for (double x = -60; x <= 60; x += 1.1) {  // a hedge along the field
        const double y = 30 + 0.3 * random.normal();
        builder.placeRandomOf(ObjectClass::Tree, hedge, x, y, {1.4, 1.4, random.uniform(1.2, 2.0)});
    }
    addBackground(builder, trees);
    return builder.build();
}

Scene makeForest(double per_m2, std::uint64_t seed) {
    SceneBuilder builder(ground(7, 0.06, 0.03, 0.12), {30, 14}, seed);
    const Shapes trees = addForestTrees(builder, 6);
    scatterTrees(builder, trees, per_m2, 2.0);
    Random& random = builder.random();
    const Shapes saplings = builder.addShapes(2, [](Random& r) {
        TreeParameters form;
        form.height_m = r.uniform(1.5, 3.0);
        form.crown_base_m = 0.4;
        form.crown_radius_m = 0.5;
        form.trunk_radius_m = 0.02;
        form.leaf_area_m2 = 1.5;
        form.leaf_m = 0.1;
        form.branches = 10;
        return makeTree(form, r);
    });
    scatterTrees(builder, saplings, 0.4 * per_m2, 0.6);
    scatterShrubs(builder, 0.01, 1.0);
    scatterTufts(builder, 0.25, 0.4);
    const std::size_t rock = builder.addShape(makeRock(random));
    builder.scatter(0.003, [&](double x, double y) {
        if (!builder.isFree(x, y, 0.6)) return;
        builder.placeRandomOf(
            ObjectClass::Wall, {rock}, x, y,
            {random.uniform(0.4, 1.0), random.uniform(0.4, 1.0), random.uniform(0.3, 0.8)});
    });
    return builder.build();
}

Scene makeWires(std::uint64_t seed) {
    const Path path{30, 14};
    SceneBuilder builder(ground(4, 0.04, 0.025, 0.12), path, seed);
    Random& random = builder.random();
    const auto run = [&](const Vector2d& from_m, const Vector2d& to_m, double span_m,
                         const std::vector<double>& heights_m, double sideways_m) {
        const Vector2d aside{random.uniform(-2, 2), random.uniform(-2, 2)};
        const Vector2d askew{random.uniform(-2, 2), random.uniform(-2, 2)};
        addWireLine(builder, from_m + aside, to_m + askew, span_m, heights_m, sideways_m);
    };
    // Wires between the straights, outside them, and across the path beyond both turns.
    run({-28, 0}, {28, 0}, 19, {2.2, 3.2, 4.2, 5.2}, 0.25);
    run({-60, -20}, {60, -22}, 24, {4.5, 6.0, 7.0}, 0.4);
    run({-60, 20}, {60, 19}, 20, {1.6, 2.8, 4.0}, 0.05);
    run({-50, -30}, {-50, 30}, 20, {1.8, 3.0, 4.4, 6.2}, 0.3);
    run({50, -30}, {50, 30}, 20, {1.8, 3.0, 4.4, 6.2}, 0.3);
    addSurroundings(builder, 0.002, 1.2);
    return builder.build();
}

Scene makeGap(std::uint64_t seed) {
    const Path path{34, 13};
    SceneBuilder builder(ground(3, 0.03, 0.02, 0.1), path, seed);
    Random& random = builder.random();
    for (const double lane : {-path.radius_m, path.radius_m}) {
        for (double at = -28; at <= 28; at += 14) {
            const double x = at + random.uniform(-3, 3), skew = random.uniform(-1.5, 1.5);
            const double gap_m = random.uniform(2.8, 4.5), height_m = random.uniform(2.5, 6.0);
            const double middle = lane + random.uniform(-0.4, 0.4);
            const double thickness_m = random.uniform(0.15, 0.5);
            const double reach_m = random.uniform(5, 9);
            addWall(builder, {x - skew, middle - gap_m / 2 - reach_m}, {x, middle - gap_m / 2},
                    height_m, thickness_m);
            addWall(builder, {x, middle + gap_m / 2}, {x + skew, middle + gap_m / 2 + reach_m},
                    height_m, thickness_m);
        }
    }
    for (int i = 0; i < 8; ++i) {  // low, free-standing walls
        const Vector2d from{random.uniform(-55, 55), random.uniform(22, 40) * (i % 2 ? 1 : -1)};
        const double angle = anyYaw(random);
        const Vector2d to =
            from + random.uniform(3, 10) * Vector2d(std::cos(angle), std::sin(angle));
        if (std::abs(to.y()) < 17) continue;
        addWall(builder, from, to, random.uniform(0.5, 1.6), 0.3);
    }
    addSurroundings(builder, 0.002, 1.0);
    return builder.build();
}

Scene makeStreet(std::uint64_t seed) {
    TerrainParameters form = ground(2, 0.03, 0.02, 0.12);
    form.paved_half_width_m = 13;
    const Path path{38, 8};
    SceneBuilder builder(form, path, seed);
    Random& random = builder.random();
    const Shapes cars = builder.addShapes(5, makeCar);
    const std::size_t lamp = builder.addShape(makeRod(6.5, 0.08));
    const std::size_t sign = builder.addShape(makeRod(2.6, 0.035));
    for (const double lane : {-11.5, 11.5, -4.2, 4.2}) {  // parked cars at kerbs and centre
        for (double at = -70; at <= 70; at += 6.2) {
            const double x = at + random.uniform(-0.6, 0.6), y = lane + 0.15 * random.normal();
            if (random.chance(0.4) || !builder.isFree(x, y, 2.0)) continue;
            const std::size_t car = builder.randomOf(cars);
            const double yaw = random.chance(0.5) ? 0.0 : kPi;
            builder.place(ObjectClass::Vehicle, car, x, y, yaw + 0.03 * random.normal());
        }
    }
    for (double x = -66; x <= 66; x += 22) {
        builder.place(ObjectClass::Pole, lamp, x, 14.5, 0);
        builder.place(ObjectClass::Pole, lamp, x + 11, -14.5, 0);
        builder.place(ObjectClass::Pole, sign, x + random.uniform(2, 9), 13.6, 0);
    }
    const Shapes trees = builder.addShapes(4, [](Random& r) {
        TreeParameters tree = forestTree(r);
        tree.height_m = r.uniform(5, 8);
        tree.leaf_area_m2 = 3.0 * tree.crown_radius_m * (tree.height_m - tree.crown_base_m);
        return makeTree(tree, r);
    });
    for (double x = -64; x <= 64; x += 9) {  // an avenue
        for (const double y : {-16.0, 0.0, 16.0}) {
            if (random.chance(0.35) || !builder.isFree(x, y, 2.0)) continue;
            const double at = x + random.normal();
            builder.placeRandomOf(ObjectClass::Tree, trees, at, y);
        }
    }
    for (const double side : {-1.0, 1.0}) {
        for (double x = -75; x < 75;) {
            const double length_m = random.uniform(8, 16);
            const double depth_m = random.uniform(8, 12), back_m = random.uniform(19, 24);
            const double wall_m = random.uniform(4, 9);
            const std::size_t house =
                builder.addShape(makeHouse(length_m, depth_m, wall_m, random));
            builder.place(ObjectClass::Building, house, x + length_m / 2,
                          side * (back_m + depth_m / 2), 0);
            if (random.chance(0.5)) {  // a garden wall
                addWall(builder, {x, side * 18}, {x + length_m, side * 18},
                        random.uniform(0.5, 1.2), 0.25);
            }
            x += length_m + random.uniform(1, 8);
        }
    }
    Shape bin;
    bin.addBox({-0.3f, -0.35f, -0.2f}, {0.3f, 0.35f, 1.1f});
    const std::size_t bins = builder.addShape(bin);
    for (int i = 0; i < 25; ++i) {
        const double x = random.uniform(-65, 65), y = random.chance(0.5) ? 14.2 : -14.2;
        builder.place(ObjectClass::Wall, bins, x, y, 0.2 * random.normal());
    }
    scatterShrubs(builder, 0.003, 1.0);
    const Shapes tufts = builder.addShapes(3, makeTuft);
    builder.scatter(0.2, [&](double x, double y) {  // weeds grow only on the verges
        if (std::abs(y) < 13.2) return;
        builder.placeRandomOf(ObjectClass::Canopy, tufts, x, y, {1, 1, random.uniform(0.1, 0.35)});
    });
    return builder.build();
}

Scene makeTerrain(std::uint64_t seed) {
    SceneBuilder builder(ground(15, 0.06, 0.035, 0.15), {30, 16}, seed);
    Random& random = builder.random();
    const Shapes trees = addForestTrees(builder, 4);
    scatterTrees(builder, trees, 0.006, 2.2);
    scatterShrubs(builder, 0.006, 1.1);
    scatterTufts(builder, 0.15, 0.35);
    const Shapes rocks = builder.addShapes(4, makeRock);
    builder.scatter(0.012, [&](double x, double y) {
        const double size = random.uniform(0.5, 2.2);
        if (!builder.isFree(x, y, 0.6 * size)) return;
        builder.placeRandomOf(
            ObjectClass::Wall, rocks, x, y,
            {size, size * random.uniform(0.7, 1.3), size * random.uniform(0.5, 1.0)});
    });
    addBackground(builder, trees);
    return builder.build();
}

Scene makeTrap(std::uint64_t seed) {
    const Path path{26, 13};
    SceneBuilder builder(ground(3, 0.03, 0.025, 0.12), path, seed);
    Random& random = builder.random();
    for (const double side : {-1.0, 1.0}) {  // beyond the turns, straight ahead of both straights
        const double size = random.uniform(0.9, 1.2), height = random.uniform(0.8, 1.3);
        addTrap(builder, {side * 51, side * -12}, side > 0 ? kPi : 0.0, 8 * size, 7 * size,
                4 * height);
        const double x = side * random.uniform(5, 15);
        addTrap(builder, {x, side * 3}, side * -kPi / 2, 6 * size, 4 * size, 3 * height);
    }
    addSurroundings(builder, 0.003, 1.0);
    return builder.build();
}

Scene makeMovers(std::uint64_t seed) {
    SceneBuilder builder(ground(3, 0.03, 0.025, 0.1), {30, 14}, seed);
    Random& random = builder.random();
    const Shapes trees = addForestTrees(builder, 3);
    scatterTrees(builder, trees, 0.004, 2.2);
    scatterTufts(builder, 0.1, 0.3);
    const std::size_t person = builder.addShape(makePerson());
    const std::size_t drone = builder.addShape(makeDrone());
    const Shapes cars = builder.addShapes(2, makeCar);
    const auto putMovers = [&](int count, double nearest, double farthest, double speed_m_s,
                               double own_radius_m, const auto& shapeOf, double low, double high) {
        for (int i = 0, tries = 0; i < count && tries < 2000; ++tries) {
            MovingObstacle mover;
            mover.shape = shapeOf();
            mover.radius_m = random.uniform(nearest, farthest);
            mover.middle_m = {random.uniform(-50, 50), random.uniform(-36, 36)};
            mover.speed_m_s = speed_m_s * random.uniform(0.6, 1.4) * (random.chance(0.5) ? 1 : -1);
            mover.phase_rad = anyYaw(random);
            mover.above_ground_m = random.uniform(low, high);
            if (builder.addMover(mover, own_radius_m)) ++i;
        }
    };
    putMovers(
        16, 2, 7, 1.4, 0.4, [&] { return person; }, 0, 0);
    putMovers(
        6, 6, 11, 5, 2.2, [&] { return builder.randomOf(cars); }, 0, 0);
    putMovers(
        5, 3, 8, 4, 0.5, [&] { return drone; }, 1.5, 6);
    addBackground(builder, trees);
    return builder.build();
}

Scene makeHall(std::uint64_t seed) {
    const Path path{12, 6};
    SceneBuilder builder(ground(0, 0, 0, 0), path, seed);
    Random& random = builder.random();
    const Vector2d corner{24, 13}, across{-24, 13};
    for (const auto& [from, to] : {std::pair{corner, across},
                                   {across, Vector2d(-corner)},
                                   {Vector2d(-corner), Vector2d(-across)},
                                   {Vector2d(-across), corner}}) {
        addWall(builder, from, to, 6, 0.3);
    }
    Shape box;
    box.addBox({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1});
    const std::size_t crate = builder.addShape(box), pillar = builder.addShape(makeRod(6, 0.2));
    for (const double x : {-20.0, -10.0, 0.0, 10.0, 20.0}) {
        for (const double y : {-10.0, 0.0, 10.0}) builder.place(ObjectClass::Pole, pillar, x, y, 0);
    }
    for (int i = 0; i < 40; ++i) {
        const double x = random.uniform(-22, 22), y = random.uniform(-11, 11);
        const double width_m = random.uniform(0.4, 1.6), height_m = random.uniform(0.3, 2.0);
        if (!builder.isFree(x, y, 0.8 * width_m)) continue;
        builder.placeRandomOf(ObjectClass::Wall, {crate}, x, y, {width_m, width_m, height_m});
    }
    return builder.build();
}

struct Scenario {
    std::string name;
    Scene (*make)(std::uint64_t seed);
};

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> known{
        {"orchard", makeOrchard},
        {"field", makeField},
        {"forest-0.02", [](std::uint64_t seed) { return makeForest(0.02, seed); }},
        {"forest-0.05", [](std::uint64_t seed) { return makeForest(0.05, seed); }},
        {"forest-0.10", [](std::uint64_t seed) { return makeForest(0.10, seed); }},
        {"wires", makeWires},
        {"gap", makeGap},
        {"street", makeStreet},
        {"terrain", makeTerrain},
        {"u-trap", makeTrap},
        {"movers", makeMovers},
        {"hall", makeHall}};
    return known;
}

}  // namespace

std::vector<std::string> scenarioNames() {
    std::vector<std::string> names;
    for (const Scenario& scenario : scenarios()) names.push_back(scenario.name);
    return names;
}

Scene makeScene(const std::string& scenario, std::uint64_t seed) {
    std::string known;
    for (const Scenario& one : scenarios()) {
        if (one.name == scenario) return one.make(seed);
        known += (known.empty() ? "" : ", ") + one.name;
    }
    throw std::invalid_argument("unknown scenario '" + scenario + "'; known: " + known);
}

}  // namespace hagen::simulation
