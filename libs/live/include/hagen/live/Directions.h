#pragma once
#include <hagen/live/SectorDistances.h>
#include <hagen/scan/Angle.h>

namespace hagen::live {

/// What messages to an autopilot are made of: the middle of the first direction is straight ahead.
using Direction = live::SectorDistances::Sector;
using DirectionState = live::SectorDistances::State;
using Directions = live::SectorDistances::Sectors;

inline live::SectorDistances::Settings aheadFirst() {
    live::SectorDistances::Settings settings;
    settings.begin_rad = -kPi / live::SectorDistances::kSectors;
    return settings;
}

}  // namespace hagen::live
