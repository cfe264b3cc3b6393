#pragma once
namespace hagen::sensors {

/// The azimuth range swept by the head of a rotating sensor, clockwise from x, at most one turn.
/// Angles increase by 2 pi per turn.
struct Sweep {
    double from_rad, to_rad;
};

/// The maximum angles of beams behind and ahead of a rotating sensor's head. A wire that only one
/// beam can hit is seen when that beam passes it.
struct BeamOffsets {
    double behind_rad = 0, ahead_rad = 0;  ///< not negative
};

}  // namespace hagen::sensors
