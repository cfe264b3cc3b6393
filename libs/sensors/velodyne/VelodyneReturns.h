#pragma once
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneBlock.h>
#include <hagen/sensors/VelodynePacket.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::sensors {

/// A turn has one reading more than a full circle; see azimuthOfReadingDeg().
constexpr double kRadiansPerReading = 2.0 * kPi / (kReadingsOfTurn - 1);

/// Offsets of returns from the first return of their block: one entry per position in a block,
/// shared by all blocks of a scan.
struct BlockOffsets {
    float distance_unit_m;
    float turn_sine[kReturnsOfBlock], turn_cosine[kReturnsOfBlock];  ///< clockwise
    float turn_rad[kReturnsOfBlock];                                 ///< clockwise
    float turn_reading[kReturnsOfBlock];                             ///< 0.01 degrees clockwise
    float min_turn_reading, max_turn_reading;
    float time_s[kReturnsOfBlock];
    float elevation_sine[kReturnsOfBlock], elevation_cosine[kReturnsOfBlock];
    float distance_m[kReturnsOfBlock];  ///< distance offset of the laser
    /// Offsets from the sensor's centre: upwards, towards the return (from the vertical offset),
    /// and sideways.
    float up_m[kReturnsOfBlock], forward_m[kReturnsOfBlock], sideways_m[kReturnsOfBlock];
    std::uint8_t row[kReturnsOfBlock];
};

/// Output arrays, as in Scan.
struct ReturnArrays {
    float *x_m, *y_m, *z_m, *intensity, *range_m, *azimuth_rad, *time_s;
    std::uint8_t* row;
};

/// Counts the returns with non-zero distance.
std::size_t countReturns(const std::vector<VelodyneBlock>& blocks);

/// locateReturns() may write up to this many entries beyond the last return.
constexpr std::size_t kPaddingReturns = 8;
void locateReturns(const std::vector<VelodyneBlock>& blocks, const BlockOffsets& places,
                   const ReturnArrays& returns);

}  // namespace hagen::sensors
