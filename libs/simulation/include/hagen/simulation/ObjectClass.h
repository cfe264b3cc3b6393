#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::simulation {

/// The object class of a simulated return, numbered as in semantic/*.label.
enum class ObjectClass : std::uint8_t {
    None = 0,
    Terrain = 1,
    Canopy = 2,  ///< low vegetation to fly over, such as crop and grass
    Tree = 3,    ///< trunks, crowns and shrubs
    Pole = 4,
    Wire = 5,
    Building = 6,
    Vehicle = 7,
    Wall = 8,  ///< walls and rocks
    Mover = 9,
    Dust = 10,
    Airframe = 11  ///< the vehicle itself
};

/// All classes of returns, in numerical order.
const std::vector<ObjectClass>& allKinds();

std::string nameOf(ObjectClass kind);

/// Returns the ground-truth label: ROU for terrain and canopy, unclassified for dust and airframe,
/// RoI for everything else at any range.
Label labelOf(ObjectClass kind);

}  // namespace hagen::simulation
