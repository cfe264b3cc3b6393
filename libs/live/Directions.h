#pragma once
#include <hagen/live/SectorDistances.h>
#include <hagen/scan/Angle.h>

namespace hagen::live {

/// Direction bins of autopilot messages. The first bin is centred straight ahead.
using Direction = SectorDistances::Sector;
using DirectionState = SectorDistances::State;
using Directions = SectorDistances::Sectors;

inline SectorDistances::Settings aheadFirst() {
    SectorDistances::Settings settings;
    settings.begin_rad = -kPi / SectorDistances::kSectors;
    return settings;
}

}  // namespace hagen::live
