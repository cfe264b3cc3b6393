#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::simulation {

/// The object class of a simulated return. The numbers are those of semantic/*.label.
enum class ObjectClass : std::uint8_t {
    None = 0,  ///< no return
    Terrain = 1,
    Canopy = 2,  ///< vegetation that is flown over: crop, tufts of grass
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

/// All classes that a return can have, in the order of their numbers.
const std::vector<ObjectClass>& allKinds();

std::string nameOf(ObjectClass kind);

/// Returns the ground-truth label: terrain and canopy are ROU, dust and airframe are unclassified,
/// everything else is RoI at any range.
Label labelOf(ObjectClass kind);

}  // namespace hagen::simulation
