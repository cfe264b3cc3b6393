#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Shape.h>

namespace hagen::simulation {

/// Parameters of a tree. The origin is the base of the trunk, which extends slightly below.
struct TreeParameters {
    double height_m = 4;
    double crown_base_m = 0.8;  ///< height at which the crown begins
    double crown_radius_m = 1.2;
    double trunk_radius_m = 0.08;
    double leaf_area_m2 = 10;  ///< total leaf area, one side
    double leaf_m = 0.15;      ///< edge length of a leaf (a triangle)
    int branches = 20;
    int low_branches = 2;  ///< below the crown, with few leaves
};

/// Makes a tree with leaves as triangles in clumps, so that beams can pass between them.
Shape makeTree(const TreeParameters& form, Random& random);

/// Makes a bush of leaves, 1 m high and wide; scale it.
Shape makeShrub(Random& random);

/// Makes a square of crop in rows along x, `side_m` long, plants up to 1 m high; scale its height.
Shape makeCanopyPatch(double side_m, Random& random);

/// Makes a tuft of blades of grass, 1 m high and 0.8 m wide; scale it.
Shape makeTuft(Random& random);

}  // namespace hagen::simulation
