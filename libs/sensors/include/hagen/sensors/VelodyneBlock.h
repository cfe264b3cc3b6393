#pragma once
#include <cstdint>

namespace hagen::sensors {

/// A block of a packet. Its direction is that of its first firing.
struct VelodyneBlock {
    const std::uint8_t* returns;  ///< 32 pairs of distance (two bytes, little-endian) and intensity
    float sine, cosine;           ///< direction of the block, clockwise from x
    float azimuth_rad;            ///< the same direction, counter-clockwise from x
    float reading_from_behind;    ///< the same in 0.01 degrees (0...35999), clockwise from behind
    float time_s;
};

}  // namespace hagen::sensors
