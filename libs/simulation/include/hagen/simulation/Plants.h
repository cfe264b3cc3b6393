#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Shape.h>

namespace hagen::simulation {

/// How a tree is grown. Its foot is the origin; the trunk reaches a little into the ground.
struct TreeForm {
    double height_m = 4;
    double crown_base_m = 0.8;  ///< where the crown begins
    double crown_radius_m = 1.2;
    double trunk_radius_m = 0.08;
    double leaf_area_m2 = 10;  ///< one side of all leaves
    double leaf_m = 0.15;      ///< edge of a leaf, a triangle
    int branches = 20;
    int low_branches = 2;  ///< below the crown, with few leaves
};

/// Trunk and branches as rods, leaves as single triangles in clumps, so that beams pass between.
Shape makeTree(const TreeForm& form, Random& random);

/// A bush of leaves, 1 m high and across; scale it.
Shape makeShrub(Random& random);

/// A square of crop in rows along x, `side_m` long, plants up to 1 m high: scale it in height.
Shape makeCanopyPatch(double side_m, Random& random);

/// A tuft of blades of grass, 1 m high and 0.8 m across: scale it.
Shape makeTuft(Random& random);

}  // namespace hagen::simulation
