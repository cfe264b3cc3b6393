#pragma once
namespace hagen::sensors {

/// The azimuths that the head of a rotating sensor passed, clockwise from x, at most one turn.
/// Angles accumulate: one turn later they are 2 pi larger.
struct Sweep {
    double from_rad, to_rad;
};

/// How far the beams of a rotating sensor point behind its head and ahead of it. An object in a
/// single beam (a wire) is seen when that beam passes it.
struct BeamOffsets {
    double behind_rad = 0, ahead_rad = 0;  ///< not negative
};

}  // namespace hagen::sensors
