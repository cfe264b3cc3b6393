#pragma once
#include <Eigen/Core>
#include <bitset>
#include <cstddef>
#include <functional>

namespace hagen::avoidance {

/// Directions around a vehicle in the map frame: 60 azimuths (from x, counter-clockwise, 6 degrees
/// apart) times 5 elevations (-0.24 to 0.24 rad). Number = 60 * elevation + azimuth.
constexpr std::size_t kDirectionAzimuths = 60, kDirectionElevations = 5;
constexpr std::size_t kDirections = kDirectionAzimuths * kDirectionElevations;
constexpr double kMaxElevation_rad = 0.24;
using DirectionSet = std::bitset<kDirections>;

/// The direction as a unit vector.
Eigen::Vector3f directionOf(std::size_t number);
double elevationOfDirection(std::size_t number);  ///< [rad]
/// Whether a direction points down to the ground, which an altimeter also detects.
bool pointsDown(std::size_t number);

/// Length of a checked direction, and radius of the sphere that must fit.
struct FreeDirectionOptions {
    float length_m = 8;
    float clearance_radius_m = 0.65f;  ///< radius of the sphere: vehicle and margin
};

/// The directions in which a sphere meets an obstacle, by sphere tracing: each step is as long as
/// the clearance allows, at least 5 cm.
DirectionSet blockedDirections(const std::function<float(const Eigen::Vector3f&)>& clearance_m,
                               const Eigen::Vector3f& position_m,
                               const FreeDirectionOptions& options = {});

/// Jaccard index of the free directions of two world models: directions free in both over
/// directions free in either. 1 if neither model has free directions.
double freeAgreement(const DirectionSet& blocked_a, const DirectionSet& blocked_b);

/// A model's directions compared with ground truth.
struct DirectionCounts {
    std::size_t scored = 0, hits = 0, false_alarms = 0, misses = 0;

    double precision() const;  ///< of blocked directions; NaN if the model blocks none
    double recall() const;     ///< NaN if no direction is truly blocked
    DirectionCounts& operator+=(const DirectionCounts& other);
};
DirectionCounts countBlocked(const DirectionSet& predicted_blocked,
                             const DirectionSet& truly_blocked, const DirectionSet& scored);

}  // namespace hagen::avoidance
