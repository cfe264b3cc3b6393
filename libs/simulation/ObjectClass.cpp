#include <hagen/simulation/ObjectClass.h>
#include <array>

namespace hagen::simulation {

const std::vector<ObjectClass>& allKinds() {
    static const std::vector<ObjectClass> kinds{
        ObjectClass::Terrain, ObjectClass::Canopy,   ObjectClass::Tree,    ObjectClass::Pole,
        ObjectClass::Wire,    ObjectClass::Building, ObjectClass::Vehicle, ObjectClass::Wall,
        ObjectClass::Mover,   ObjectClass::Dust,     ObjectClass::Airframe};
    return kinds;
}

std::string nameOf(ObjectClass kind) {
    static const std::array<const char*, 12> names{"none", "terrain", "canopy",   "tree",
                                                   "pole", "wire",    "building", "vehicle",
                                                   "wall", "mover",   "dust",     "airframe"};
    return names.at(static_cast<std::size_t>(kind));
}

Label labelOf(ObjectClass kind) {
    switch (kind) {
        case ObjectClass::None:
        case ObjectClass::Dust:
        case ObjectClass::Airframe:
            return Label::Unclassified;
        case ObjectClass::Terrain:
        case ObjectClass::Canopy:
            return Label::Rou;
        default:
            return Label::Roi;
    }
}

}  // namespace hagen::simulation
