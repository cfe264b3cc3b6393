#include <hagen/simulation/Kind.h>
#include <array>

namespace hagen::simulation {

const std::vector<Kind>& allKinds() {
    static const std::vector<Kind> kinds{Kind::Terrain, Kind::Canopy,   Kind::Tree,    Kind::Pole,
                                         Kind::Wire,    Kind::Building, Kind::Vehicle, Kind::Wall,
                                         Kind::Mover,   Kind::Dust,     Kind::Airframe};
    return kinds;
}

std::string nameOf(Kind kind) {
    static const std::array<const char*, 12> names{"none", "terrain", "canopy",   "tree",
                                                   "pole", "wire",    "building", "vehicle",
                                                   "wall", "mover",   "dust",     "airframe"};
    return names.at(static_cast<std::size_t>(kind));
}

Label labelOf(Kind kind) {
    switch (kind) {
        case Kind::None:
        case Kind::Dust:
        case Kind::Airframe:
            return Label::Unclassified;
        case Kind::Terrain:
        case Kind::Canopy:
            return Label::Rou;
        default:
            return Label::Roi;
    }
}

}  // namespace hagen::simulation
