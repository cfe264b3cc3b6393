#pragma once
#include <hagen/range_image/Angle.h>
#include <hagen/streaming/SectorDistances.h>

namespace hagen::autopilot {

/// What messages to an autopilot are made of: the middle of the first direction is straight ahead.
using Direction = streaming::SectorDistances::Sector;
using DirectionState = streaming::SectorDistances::State;
using Directions = streaming::SectorDistances::Sectors;

inline streaming::SectorDistances::Settings aheadFirst() {
    streaming::SectorDistances::Settings settings;
    settings.begin_rad = -kPi / streaming::SectorDistances::kSectors;
    return settings;
}

}  // namespace hagen::autopilot
