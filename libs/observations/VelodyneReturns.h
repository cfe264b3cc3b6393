#pragma once
#include <hagen/observations/VelodyneBlock.h>
#include <hagen/range_image/Angle.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// A block holds so many returns.
constexpr std::size_t kReturnsOfBlock = 32;

/// Distances in packets count these.
constexpr float kDistanceUnit_m = 0.002f;

/// A turn has so many azimuth readings, and is one of them longer than a full circle: see
/// azimuthOfReadingDeg().
constexpr int kReadingsOfTurn = 36000;
constexpr double kRadiansPerReading = 2.0 * kPi / (kReadingsOfTurn - 1);

/// What tells a return from the first of its block: an entry a place in the block, the same in all
/// blocks of a scan.
struct PlacesInBlock {
    float turn_sine[kReturnsOfBlock], turn_cosine[kReturnsOfBlock];  ///< clockwise
    float turn_rad[kReturnsOfBlock];                                 ///< clockwise
    float turn_reading[kReturnsOfBlock];                             ///< 0.01 degrees clockwise
    float least_turn_reading, most_turn_reading;
    float time_s[kReturnsOfBlock];
    float elevation_sine[kReturnsOfBlock], elevation_cosine[kReturnsOfBlock];
    float distance_m[kReturnsOfBlock];  ///< added to what the laser measures
    /// Off the sensor's middle: upwards, towards the return by being upwards, and sideways.
    float up_m[kReturnsOfBlock], forward_m[kReturnsOfBlock], sideways_m[kReturnsOfBlock];
    std::uint8_t row[kReturnsOfBlock];
};

/// Where returns are to be written, as in Scan.
struct ReturnArrays {
    float *x_m, *y_m, *z_m, *intensity, *range_m, *azimuth_rad, *time_s;
    std::uint8_t* row;
};

/// The returns of these blocks whose distance is not 0.
std::size_t countReturns(const std::vector<VelodyneBlock>& blocks);

/// Writes them, in the order of the blocks. May write kSpareReturns more entries behind the last.
constexpr std::size_t kSpareReturns = 8;
void locateReturns(const std::vector<VelodyneBlock>& blocks, const PlacesInBlock& places,
                   const ReturnArrays& returns);

}  // namespace hagen::observations
