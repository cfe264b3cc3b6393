#pragma once
#include <Eigen/Core>
#include <bitset>
#include <cstddef>
#include <functional>

namespace hagen::openloop {

/// Directions around a vehicle, in the map: 60 azimuths (from x, counter-clockwise, 6 degrees
/// apart) times 5 elevations (-0.24 to 0.24 rad). Number = 60 * elevation + azimuth.
constexpr std::size_t kDirectionAzimuths = 60, kDirectionElevations = 5;
constexpr std::size_t kDirections = kDirectionAzimuths * kDirectionElevations;
constexpr double kHighestDirection_rad = 0.24;
using DirectionSet = std::bitset<kDirections>;

/// A unit vector.
Eigen::Vector3f directionOf(std::size_t number);
double elevationOfDirection(std::size_t number);  ///< [rad]
/// Whether a direction leads down: to the ground, sooner or later, which an altimeter tells, too.
bool leadsDown(std::size_t number);

/// How far, and with how much room, a vehicle goes in a direction.
struct FreeDirectionOptions {
    float length_m = 8;
    float room_m = 0.65f;  ///< radius of the sphere that goes there: vehicle and margin
};

/// The directions in which a sphere meets an obstacle: sphere stepping, a step as long as the
/// clearance lets it be, 5 cm at least.
DirectionSet blockedDirections(const std::function<float(const Eigen::Vector3f&)>& clearance_m,
                               const Eigen::Vector3f& position_m,
                               const FreeDirectionOptions& options = {});

/// Jaccard's index of the free directions of two world models: those free in both, over those free
/// in either. 1 where neither has any.
double freeAgreement(const DirectionSet& blocked_a, const DirectionSet& blocked_b);

/// What a model says of directions, counted against the truth where there is one.
struct DirectionCounts {
    std::size_t scored = 0, hits = 0, false_alarms = 0, misses = 0;

    double precision() const;  ///< of blocked directions; NaN where none is called blocked
    double recall() const;     ///< NaN where none is blocked
    DirectionCounts& operator+=(const DirectionCounts& other);
};
DirectionCounts countBlocked(const DirectionSet& said_blocked, const DirectionSet& truly_blocked,
                             const DirectionSet& scored);

}  // namespace hagen::openloop
