#pragma once
#include <hagen/range_image/Label.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::simulation {

/// What a simulated return came from. The numbers are those of semantic/*.label.
enum class Kind : std::uint8_t {
    None = 0,  ///< nothing came back
    Terrain = 1,
    Canopy = 2,  ///< crop, tufts of grass: what grows on the ground and is flown over
    Tree = 3,    ///< trunk, crown and shrubs
    Pole = 4,
    Wire = 5,
    Building = 6,
    Vehicle = 7,
    Wall = 8,  ///< walls and rocks
    Mover = 9,
    Dust = 10,
    Airframe = 11  ///< the vehicle that carries the sensor
};

/// All kinds that a return can have, in the order of their numbers.
const std::vector<Kind>& allKinds();

std::string nameOf(Kind kind);

/// The true label: terrain and canopy are ROU, dust and airframe are unclassified, the rest is RoI
/// wherever it is (a score leaves out what lies beyond the zone).
Label labelOf(Kind kind);

}  // namespace hagen::simulation
