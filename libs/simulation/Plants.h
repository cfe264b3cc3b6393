#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Shape.h>

namespace hagen::simulation {

/// Parameters of a tree. The origin is the base of the trunk, which extends slightly below it.
struct TreeParameters {
    double height_m = 4;
    double crown_base_m = 0.8;  ///< height at which the crown begins
    double crown_radius_m = 1.2;
    double trunk_radius_m = 0.08;
    double leaf_area_m2 = 10;  ///< total leaf area (one side)
    double leaf_m = 0.15;      ///< edge length of the triangular leaves
    int branches = 20;
    int low_branches = 2;  ///< branches below the crown, with few leaves
};

/// Makes a tree. Its leaves are triangles in clumps, so that beams can pass between them.
Shape makeTree(const TreeParameters& form, Random& random);

/// Makes a bush of leaves, 1 m high and 1 m wide. Callers scale it.
Shape makeShrub(Random& random);

/// Makes a square field, `side_m` wide, with crop rows along x and plants up to 1 m high. Callers
/// scale its height.
Shape makeCanopyPatch(double side_m, Random& random);

/// Makes a tuft of grass, 1 m high and 0.8 m wide. Callers scale it.
Shape makeTuft(Random& random);

}  // namespace hagen::simulation
